#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/replay/replay_warnings.h"
#include "base/error.h"
#include "base/stage_times.h"
#include "devices/recordings/recording.h"
#include "export/trajectories/mcap_trajectory.h"
#include "scene/scene_description.h"
#include "session/frame_prefetch.h"
#include "session/marker_tracks.h"
#include "tracker/tracker.h"

namespace pleinair::app {

/// What is known of a recording before its markers are sought.
struct TrackRecordingOptions {
  std::string recording;  ///< Its name, for errors.
  const scene::SceneDescription& scene;
  std::filesystem::path detections;  ///< File to write what is seen to, a line a frame.
  bool keep_messages = false;        ///< Also in memory.
};

/// What TrackRecording gives: the markers' poses and prints, and what went wrong on the way.
struct RecordingTracks {
  session::MarkerTracks marker_tracks;
  FrameWarnings warnings{};  ///< The tracker's.
  std::vector<exports::MarkersMessage>
      messages{};                ///< The lines of `detections`, if they are to be kept.
  std::int64_t lost_frames = 0;  ///< Which the recorder had to leave out.
};

/// Tracks the markers of a recording's frames and measures their prints; reading, tracking and
/// measuring run beside each other. Adds the time of each stage to `times`.
/// Errors: a frame that cannot be read or lies centuries away, no frames, the file, an interrupt.
Result<RecordingTracks> TrackRecording(const TrackRecordingOptions& search,
                                       devices::Recording recording, tracker::Tracker& tracker,
                                       StageTimes* times);

/// The next frame; nothing at the end. Errors: the source's, an interrupt.
Result<std::optional<devices::Frame>> NextFrame(const std::string& recording,
                                                session::FramePrefetcher& frames);

}  // namespace pleinair::app
