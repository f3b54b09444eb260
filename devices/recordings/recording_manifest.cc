#include "devices/recordings/recording_manifest.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "files/json_fields.h"

namespace pleinair::devices {
namespace {

constexpr int kMaxFrames = 100'000'000;
constexpr double kMaxStamp_s = 1e9;  // 30 years: still exact to nanoseconds in 64 bits.

std::string ShortNumber(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", value);
  return text.data();
}

Result<void> CheckStamps(const std::vector<double>& stamps_s, const files::JsonFields& fields) {
  for (std::size_t i = 0; i < stamps_s.size(); ++i) {
    if (std::fabs(stamps_s[i]) > kMaxStamp_s) {
      return fields.Fail("timestamps_s",
                         "is " + ShortNumber(stamps_s[i]) + " at frame " + std::to_string(i) +
                             ", outside -1e9 to 1e9",
                         "give seconds, counted from the first frame");
    }
    if (i == 0) continue;
    const double step_s = stamps_s[i] - stamps_s[i - 1];
    if (step_s <= 0.0) {
      return fields.Fail("timestamps_s", "does not ascend at frame " + std::to_string(i),
                         "each time stamp must be later than the one before, in seconds");
    }
    // Rounding of stamps of 30 years is 1e-7 s.
    if (step_s < 0.99 * kMinStep_s || step_s > kMaxStep_s) {
      return fields.Fail("timestamps_s",
                         "has frame " + std::to_string(i) + " " + ShortNumber(step_s) +
                             " s after the one before, outside 1e-5 s to a year",
                         "give the time stamps in seconds");
    }
  }
  return {};
}

}  // namespace

Result<RecordingManifest> ParseRecordingManifest(std::string_view bytes, const std::string& name) {
  PLEINAIR_ASSIGN_OR_RETURN(const files::Json document, files::ParseJson(bytes, name));
  const files::JsonFields top(document, name);
  // scene.json keeps these fields in "image" and calls the rate fps.
  const bool in_image = !top.Has("frames") && top.Object("image").Has("frames");
  const files::JsonFields fields = in_image ? top.Object("image") : top;
  const char* rate_key = fields.Has("frame_rate_hz") ? "frame_rate_hz" : "fps";

  RecordingManifest manifest;
  manifest.has_calibration = top.Has("calibration");
  PLEINAIR_ASSIGN_OR_RETURN(manifest.frames, fields.Text("frames"));
  if (manifest.frames && manifest.frames->empty()) {
    return fields.Fail("frames", "is empty", "name the folder of the frames or the video");
  }
  PLEINAIR_ASSIGN_OR_RETURN(manifest.frame_count, fields.Integer("frame_count"));
  if (manifest.frame_count && (*manifest.frame_count < 1 || *manifest.frame_count > kMaxFrames)) {
    return fields.Fail("frame_count",
                       "is " + std::to_string(*manifest.frame_count) + ", outside 1 to 100000000",
                       "count the frames from 1");
  }
  PLEINAIR_ASSIGN_OR_RETURN(manifest.frame_rate_hz, fields.Number(rate_key));
  if (manifest.frame_rate_hz &&
      (*manifest.frame_rate_hz < kMinRate_hz || *manifest.frame_rate_hz > kMaxRate_hz)) {
    return fields.Fail(rate_key,
                       "is " + ShortNumber(*manifest.frame_rate_hz) + ", outside 1e-7 to 1e5",
                       "give frames a second");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::vector<double>> stamps,
                            fields.Numbers("timestamps_s"));
  manifest.timestamps_s = stamps.value_or(std::vector<double>());
  PLEINAIR_RETURN_IF_ERROR(CheckStamps(manifest.timestamps_s, fields));
  const auto count = static_cast<int>(manifest.timestamps_s.size());
  if (manifest.frame_count && count > 0 && count != *manifest.frame_count) {
    return fields.Fail("timestamps_s",
                       "has " + std::to_string(count) + " entries for " +
                           std::to_string(*manifest.frame_count) + " frames",
                       "give one time stamp for each frame, or none");
  }
  if (!manifest.frame_count && count > 0) manifest.frame_count = count;
  if (!manifest.frame_rate_hz && count > 1) {
    manifest.frame_rate_hz =
        (count - 1) / (manifest.timestamps_s.back() - manifest.timestamps_s.front());
  }
  return manifest;
}

}  // namespace pleinair::devices
