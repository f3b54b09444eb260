#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/light_options.h"

namespace pleinair::app {

/// Camera controls to lock.
struct LiveHolds {
  bool all = false;  ///< Controls without a value are locked at their current value.
  std::optional<double> exposure_s, gain, white_balance_k, focus;
};

/// The camera or recording, and its descriptions.
struct LiveInputs {
  std::string camera, scene, calibration, time, pixel_format;
  std::optional<double> rate_hz;
  bool loop = false;
  LiveHolds holds;
};

struct LiveOutputs {
  std::string recording, detections, screenshot;
  std::string folder;
  std::vector<std::string> exports;
};

struct LiveWindowArguments {
  std::string size, screenshots = ".";
  std::string saved_scene;  ///< A new file; empty: the scene's own.
  double ui_scale = 0.0;
};

struct LiveArguments {
  LiveInputs input;
  LiveOutputs output;
  LiveWindowArguments window;
  session::LightOptions light;
  std::optional<double> seconds, report_every_s;
  bool headless = false, lossless = false, json = false, shadow_debug = false;
};

}  // namespace pleinair::app
