#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/options/antialiasing_options.h"
#include "app/options/defocus_options.h"
#include "app/options/motion_blur_options.h"
#include "app/replay/replay.h"

namespace pleinair::app {

/// Parsed command line of `replay` or `bench replay`.
struct ReplayArguments {
  std::string command = "replay";  ///< Words after `pleinair`.
  ReplayOptions options;           ///< Options that need no conversion.
  struct Paths {
    std::vector<std::string> recordings;  ///< As given.
    std::string recording;                ///< One of them.
    std::string output, scene, calibration;
  } paths;
  std::string shard;  ///< Part of several recordings; empty: all.
  std::string size;
  std::vector<std::string> exports;
  struct Drawing {
    std::vector<double> fog;
    AntialiasingArguments antialiasing;
    DefocusArguments defocus;
    MotionBlurArguments motion_blur;
  } drawing;
  struct Day {
    std::string hours, every;
    std::optional<std::int64_t> frame;
  } day;  ///< Options of the time-lapse.
  struct Range {
    std::optional<std::int64_t> frame;
    std::optional<double> from_s, to_s;
  } range;
  struct Written {
    bool frames = false, no_video = false, resume = false;
  } written;
  bool json = false;
  struct Research {
    std::string shadows = "ours";
    std::vector<int> shadow_sizes;
    std::string shader_directory;
  } research;  ///< Only for `bench replay`.
};

}  // namespace pleinair::app
