#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/replay/replay.h"

namespace pleinair::app {

/// A command line of `replay` or `bench replay`, as the parser fills it in.
struct ReplayArguments {
  std::string command = "replay";  ///< What stands behind `pleinair`.
  ReplayOptions options;           ///< What the parser writes as it is.
  struct Paths {
    std::string recording, output, scene, calibration;
  } paths;
  std::string size;
  std::vector<std::string> exports;
  std::vector<double> fog;
  struct Day {
    std::string hours, every = "10min";
    std::optional<std::int64_t> frame;
  } day;  ///< Of the time-lapse.
  bool no_video = false;
  bool json = false;
  struct Research {
    std::string shadows = "ours";
    std::vector<int> shadow_sizes;
    std::string shader_directory;
  } research;  ///< Of `bench replay` alone.
};

}  // namespace pleinair::app
