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
#include "app/options/shard_option.h"
#include "base/error.h"

namespace pleinair::app {

/// Frames that are measured and stored together.
struct AccuracyChunk {
  std::vector<accuracy::FrameRun> runs;
  std::optional<std::string> recording{};  ///< If set, `runs` is empty.
  bool light = false;  ///< Recordings only: measure the composited images, not the frames.
};

/// Divides the frames of a run into chunks, equally for all workers.
std::vector<AccuracyChunk> PlanChunks(const AccuracyConfig& config);

/// Index of the first frame of a chunk in the order of frames.
constexpr std::int64_t FirstFrameOf(std::int64_t chunk) { return chunk << 20; }

struct RunOutcome {
  std::int64_t chunks = 0;           ///< In this shard.
  std::int64_t measured = 0;         ///< Measured now; the others existed.
  std::vector<std::string> skipped;  ///< Messages about chunks that could not be measured.
  ErrorKind skipped_kind = ErrorKind::kInput;  ///< kSystem: one or more for that reason.
  std::set<std::string> skipped_recordings;    ///< Recordings of these messages.
};

/// Measures the missing chunks of a shard, with `threads` threads.
Result<RunOutcome> MeasureShard(const RecordParts& parts, const Shard& shard, int threads);

/// Renders one frame of the run again, with our marker, for the page. Nothing if it cannot be
/// rendered.
std::optional<GreyImage> PictureOf(const AccuracyConfig& config, std::int64_t frame);

}  // namespace pleinair::app
