#pragma once

#include "app/replay/replay_options.h"
#include "app/replay/report/report.h"
#include "base/error.h"

namespace pleinair::app {

/// Composes a recording into a folder: composite.mp4, frames/, poses/, detections.jsonl,
/// report.json and report.html, and the forms of the path that are asked for. Reads the recording
/// thrice (markers, light, pictures), a dozen frames in memory at a time; reading,
/// drawing and writing run beside each other, with the same results on any number of processors.
/// All outputs appear at the end; on an error nothing is left.
Result<ReplayReport> Replay(const ReplayOptions& options);

}  // namespace pleinair::app
