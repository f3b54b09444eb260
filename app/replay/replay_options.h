#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "app/replay/time_lapse/moments.h"
#include "base/image_size.h"
#include "compositor/composer_options.h"
#include "export/trajectories/trajectory_files.h"
#include "session/light_options.h"

namespace pleinair::app {

/// What to replay, and how.
struct ReplayOptions {
  std::filesystem::path recording;
  std::filesystem::path output;                      ///< Folder; made where missing.
  std::optional<std::filesystem::path> scene;        ///< Overrides the recording's own.
  std::optional<std::filesystem::path> calibration;  ///< Needed for a plain video.
  bool write_frames = false;
  bool write_video = true;
  std::set<exports::TrajectoryFormat> exports;  ///< Forms of the path besides TUM.
  compositor::ComposerOptions composer;
  session::LightOptions light;
  std::optional<ImageSize> size;  ///< Of the output; markers are sought at the recording's size.
  std::optional<TimeLapseOptions> time_lapse;  ///< A day of the scene besides.
  std::string command;                         ///< For the report.
};

}  // namespace pleinair::app
