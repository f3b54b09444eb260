#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "accuracy/frame_renderer.h"
#include "accuracy/scene.h"
#include "app/accuracy/accuracy_config.h"
#include "app/accuracy/record_parts.h"
#include "base/error.h"

namespace pleinair::app {

/// Frames that are measured together and kept together.
struct AccuracyChunk {
  std::vector<accuracy::FrameRun> runs;
  std::optional<std::string> recording{};  ///< Then without runs.
  bool light = false;  ///< Of a recording: its composed pictures in place of its frames.
};

/// The frames of a run in chunks: the same for everybody who works on it.
std::vector<AccuracyChunk> PlanChunks(const AccuracyConfig& config);

/// Place of the first frame of a chunk in the order of frames.
constexpr std::int64_t FirstFrameOf(std::int64_t chunk) { return chunk << 20; }

/// A part of a run: the chunks whose place, divided by `count`, leaves `index` - 1.
struct Shard {
  int index = 1, count = 1;
};

struct RunOutcome {
  std::int64_t chunks = 0;                   ///< Of this shard,
  std::int64_t measured = 0;                 ///< … measured now, the others having been there.
  std::vector<std::string> skipped;          ///< Messages about what could not be measured.
  std::set<std::string> skipped_recordings;  ///< Those that the messages are of.
};

/// Measures what is not there yet of a shard, with `threads` threads.
Result<RunOutcome> MeasureShard(const RecordParts& parts, const Shard& shard, int threads);

/// One frame of the run again, with our print: for the page. Nothing where it cannot be had.
std::optional<GreyImage> PictureOf(const AccuracyConfig& config, std::int64_t frame);

}  // namespace pleinair::app
