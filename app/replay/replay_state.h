#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/drape/scene_ink.h"
#include "app/output/output_folder.h"
#include "app/replay/frame_warnings.h"
#include "app/replay/replay_options.h"
#include "app/replay/report/report.h"
#include "app/replay/time_lapse/moments.h"
#include "base/error.h"
#include "base/stage_times.h"
#include "devices/recordings/frame_range.h"
#include "devices/recordings/recording.h"
#include "export/trajectories/mcap_trajectory.h"
#include "session/pipeline.h"
#include "session/scene_renderer.h"

namespace pleinair::app {

/// Data shared by the steps of one replay.
struct ReplayState {
  const ReplayOptions& options;
  OutputFolder folder;
  WrittenOutputs write = options.write;  ///< For a photograph: frames and no video.
  std::unique_ptr<session::Pipeline> pipeline{};
  std::shared_ptr<SceneInk> ink{};                  ///< Null: the scene has no maps.
  FrameWarnings frame_warnings{};                   ///< From the tracker.
  std::vector<exports::MarkersMessage> messages{};  ///< Lines of detections.jsonl, for MCAP.
  /// Of the frames in the range.
  struct {
    std::int64_t first_stamp_ns = 0;
    std::int64_t lost_frames = 0;  ///< Dropped by the recorder.
  } read{};
  TimeLapseMoments day_moments{};
  StageTimes times{};
  ReplayReport report{};
  std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();

  Result<devices::Recording> OpenRecording() const {
    PLEINAIR_ASSIGN_OR_RETURN(
        devices::Recording recording,
        devices::OpenRecording(options.recording, {options.calibration, options.scene}));
    recording.frames = devices::LimitFrames(std::move(recording.frames), options.range,
                                            options.recording.string());
    return recording;
  }
  const scene::SceneDescription& scene() const { return pipeline->scene(); }
  session::SceneRenderer& renderer() const { return pipeline->renderer(); }
  /// True if a time-lapse is requested and can be drawn. Valid once the trajectory is known.
  bool DrawsDay() const {
    return options.time_lapse && !report.path.empty() && scene().DrawsAnything();
  }
};

}  // namespace pleinair::app
