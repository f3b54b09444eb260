#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/error.h"
#include "devices/recordings/recording.h"
#include "session/marker_tracks.h"
#include "session/pipeline.h"
#include "session/recording_passes.h"
#include "session/trajectory/given_trajectory.h"

namespace pleinair::app {

/// Indices of at most 24 frames within 0.6 s, or 12 frames, of those of a sample that show the
/// marker. They ascend and leave out the sample's own. Empty if the sample itself shows it in 24
/// frames, or in none. `track`: the frames of the sample that show the marker.
std::vector<std::int64_t> FramesNearSample(const std::vector<session::FrameTime>& sample,
                                           const std::vector<session::Observation>& track);

/// The reference marker in frames near those of a tracked sample that show it. With them, the
/// offset of a trajectory's clock can be estimated where the marker is in view for a second of a
/// minute. Empty where no offset is estimated. `open` opens the recording at its start. Errors:
/// those of `open`, Pipeline::Create() and TrackRecording().
Result<std::vector<session::Observation>> ViewsNearSample(
    const session::Pipeline& sample, const session::TrajectoryRequest& request,
    const std::function<Result<devices::Recording>()>& open, const session::PassMonitor& monitor);

}  // namespace pleinair::app
