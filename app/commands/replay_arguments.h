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
  std::string recording, output, scene, calibration, size;
  std::vector<std::string> exports;
  std::vector<double> fog;
  std::string time_lapse, every = "10min";
  std::optional<std::int64_t> time_lapse_frame;
  bool no_video = false;
  bool json = false;

  // Of `bench replay` alone.
  std::string shadows = "ours";
  std::vector<int> shadow_sizes;
  std::string shader_directory;
};

}  // namespace pleinair::app
