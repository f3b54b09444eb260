#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace pleinair::devices {

/// Range of frame rates: from three frames a year to the fastest cameras.
inline constexpr double kMinRate_hz = 1e-7, kMaxRate_hz = 1e5;
/// Range of the time between frames: from the fastest rate to a year.
inline constexpr double kMinStep_s = 1e-5, kMaxStep_s = 366.0 * 86400.0;

/// Description of the frames in a recording.json or scene.json.
struct RecordingManifest {
  std::optional<std::string> frames;  ///< Folder, printf pattern or video, relative to the file.
  std::optional<int> frame_count;
  std::optional<double> frame_rate_hz;
  bool has_calibration = false;      ///< The file has a "calibration" block.
  std::vector<double> timestamps_s;  ///< Ascending; empty if absent.
};

/// Errors: truncated or invalid JSON; count or rate not positive; time stamps that do not ascend or
/// whose number differs from the frames'.
Result<RecordingManifest> ParseRecordingManifest(std::string_view bytes, const std::string& name);

}  // namespace pleinair::devices
