#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "app/replay/time_lapse/moments.h"
#include "base/image_size.h"
#include "compositor/composer_options.h"
#include "devices/recordings/frame_range.h"
#include "export/trajectories/trajectory_files.h"
#include "scene/trajectory_description.h"
#include "session/light_options.h"

namespace pleinair::app {

/// Images and trajectories that a replay writes.
struct WrittenOutputs {
  bool frames = false;  ///< One file a frame.
  bool video = true;
  std::set<exports::TrajectoryFormat> exports{};  ///< Trajectory formats in addition to TUM.
  bool is_resumable = false;  ///< Unfinished outputs are kept, and a later replay goes on.
};

/// Input and options of a replay.
struct ReplayOptions {
  std::filesystem::path recording;
  std::filesystem::path output;                      ///< Folder; created if missing.
  std::optional<std::filesystem::path> scene;        ///< Replaces the recording's scene.
  std::optional<std::filesystem::path> calibration;  ///< Required for a plain video.
  devices::FrameRange range;                         ///< Part of the recording; all by default.
  WrittenOutputs write;
  /// Given on the command line; without a file, the scene's counts.
  scene::TrajectoryDescription trajectory;
  compositor::ComposerOptions composer;
  session::LightOptions light;
  std::optional<ImageSize> size;  ///< Of the output; detection uses the recording's size.
  std::optional<TimeLapseOptions> time_lapse;  ///< Also draw the scene over time.
  std::string command;                         ///< For the report.
};

}  // namespace pleinair::app
