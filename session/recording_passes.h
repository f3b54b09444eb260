#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "base/error.h"
#include "base/image.h"
#include "base/stage_times.h"
#include "devices/frame.h"
#include "devices/recordings/recording.h"
#include "session/pipeline.h"

namespace pleinair::session {

/// Receives the progress and the stage times of a pass over a recording.
struct PassMonitor {
  /// Called before each frame and once at the end, with the number of frames done and, if known, of
  /// all frames. An error stops the pass, which returns it. May be empty.
  std::function<Result<void>(std::int64_t done, std::optional<std::int64_t> of)> progress;
  /// Receives the milliseconds of each stage. May be null.
  StageTimes* times = nullptr;
};

/// Receives a frame and its markers. An error stops the pass.
using TrackedFrameCallback = std::function<Result<void>(const devices::Frame&, TrackedFrame)>;

/// Receives a frame, resized to the size of composed images, and the frame composed from it. An
/// error stops the pass.
using ComposedFrameCallback = std::function<Result<void>(const devices::Frame&, ComposedFrame)>;

/// Returns the composed image of a frame where an earlier pass, which did not end, composed it.
using EarlierImage = std::function<std::optional<RgbImage>(std::int64_t frame_index)>;

/// First pass: detects the markers of all frames and estimates their poses. Reading, detection and
/// pose estimation run at the same time, with about a dozen frames in memory. `take` is called in
/// the order of the frames, on a thread of the pass.
/// Errors: an unreadable frame, a time outside the years 1678 to 2261, a recording without frames,
/// the errors of `take` and of the monitor.
Result<void> TrackRecording(Pipeline& pipeline, devices::Recording recording,
                            const TrackedFrameCallback& take = {}, const PassMonitor& monitor = {});

/// Estimates the camera's response from the frames of TrackRecording(), and uses it from then on if
/// they contradict sRGB strongly (SceneRenderer::EstimateResponse()). EstimateLight() does so, too.
Result<void> EstimateResponse(Pipeline& pipeline);

/// Second pass: estimates heading, sun and sky from at most eight frames (LightFrames). Does
/// nothing if no frame has a pose or the scene has no phantoms. Errors: an unreadable frame, the
/// errors of the monitor.
Result<void> EstimateLight(Pipeline& pipeline, devices::Recording recording,
                           const PassMonitor& monitor = {});

/// Last pass: composes every frame. `take` is called in the order of the frames, on the calling
/// thread. A frame without a pose stays unchanged. Frames of which `earlier` has the image are not
/// drawn again; all others have the same bytes as in a pass without it.
/// Errors: an unreadable frame, drawing, a recording that changed since the first pass, the errors
/// of `take` and of the monitor.
Result<void> ComposeFrames(Pipeline& pipeline, devices::Recording recording,
                           const ComposedFrameCallback& take, const PassMonitor& monitor = {},
                           const EarlierImage& earlier = {});

/// Runs all three passes over a recording that has a scene of its own, as `pleinair replay` does.
/// Errors: those of OpenRecording(), Pipeline::Create() and the passes; a recording without a
/// scene.
Result<void> ComposeRecording(const std::filesystem::path& recording,
                              const PipelineOptions& options, const ComposedFrameCallback& take);

}  // namespace pleinair::session
