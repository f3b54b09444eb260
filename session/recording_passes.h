#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "base/error.h"
#include "base/stage_times.h"
#include "devices/frame.h"
#include "devices/recordings/recording.h"
#include "session/pipeline.h"

namespace pleinair::session {

/// Hears how a pass over a recording goes on.
struct PassMonitor {
  /// Called before each frame with the frames that are done, and of how many, where that is known;
  /// and once more at the end. An error stops the pass, which gives it back. May be empty.
  std::function<Result<void>(std::int64_t done, std::optional<std::int64_t> of)> progress;
  /// Gets the milliseconds of each stage; may be null.
  StageTimes* times = nullptr;
};

/// Takes a frame whose markers were measured. An error stops the pass.
using TrackedFrameCallback = std::function<Result<void>(const devices::Frame&, TrackedFrame)>;

/// Takes a frame (of the size of composed images) and what was composed from it. An error stops the
/// pass.
using ComposedFrameCallback = std::function<Result<void>(const devices::Frame&, ComposedFrame)>;

/// First pass: finds and measures the markers of all frames. Reading, finding and measuring run
/// beside each other, a dozen frames in memory at a time; `take` is called in the frames' order, on
/// a thread of the pass.
/// Errors: a frame that cannot be read or whose moment lies outside the years 1678 to 2261, no
/// frames, those of `take` and of the monitor.
Result<void> TrackRecording(Pipeline& pipeline, devices::Recording recording,
                            const TrackedFrameCallback& take = {}, const PassMonitor& monitor = {});

/// Second pass, after the first: reads heading, sun and sky from at most eight frames
/// (LightFrames). Errors: a frame that cannot be read, those of the monitor.
Result<void> EstimateLight(Pipeline& pipeline, devices::Recording recording,
                           const PassMonitor& monitor = {});

/// Last pass: composes every frame. `take` gets them in order, on the calling thread; frames
/// without a pose stay as they are. Errors: a frame that cannot be read, drawing, other frames than
/// the first pass had, those of `take` and of the monitor.
Result<void> ComposeFrames(Pipeline& pipeline, devices::Recording recording,
                           const ComposedFrameCallback& take, const PassMonitor& monitor = {});

/// All three passes over a recording with a scene of its own: what `pleinair replay` does.
/// Errors: OpenRecording's, a recording without a scene, Pipeline::Create's and those of the
/// passes.
Result<void> ComposeRecording(const std::filesystem::path& recording,
                              const PipelineOptions& options, const ComposedFrameCallback& take);

}  // namespace pleinair::session
