#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/antialiasing_options.h"
#include "app/options/defocus_options.h"
#include "app/options/motion_blur_options.h"
#include "session/light_options.h"

namespace pleinair::app {

/// Camera controls that `live` locks (--lock, --hold-…).
struct LiveHolds {
  bool all = false;  ///< Controls without a value are locked at their current value.
  /// Values to lock. Units: seconds, the camera's steps, kelvins, the camera's steps.
  std::optional<double> exposure_s, gain, white_balance_k, focus;
};

/// Options of `live` that name the camera or recording, and its descriptions.
struct LiveInputs {
  std::string camera, scene, calibration, time, pixel_format;
  std::optional<double> rate_hz;
  bool loop = false;
  LiveHolds holds;
};

/// Files and folders that `live` writes; empty: not written.
struct LiveOutputs {
  std::string recording, detections, screenshot;
  std::string folder;
  std::vector<std::string> exports;
};

/// Options of the window of `live`.
struct LiveWindowArguments {
  std::string size, screenshots = ".";
  std::string saved_scene;  ///< A new file; empty: the scene's own.
  double ui_scale = 0.0;    ///< Font scale; 0: the screen's scale.
};

/// Arguments of the command `live`.
struct LiveArguments {
  LiveInputs input;
  LiveOutputs output;
  LiveWindowArguments window;
  session::LightOptions light;
  struct Drawing {
    AntialiasingArguments antialiasing;
    DefocusArguments defocus;
    MotionBlurArguments motion_blur;
  } drawing;
  std::optional<double> seconds, report_every_s;
  bool headless = false, lossless = false, json = false, shadow_debug = false;
};

}  // namespace pleinair::app
