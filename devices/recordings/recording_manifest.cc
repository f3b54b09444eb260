#include "devices/recordings/recording_manifest.h"

#include <cmath>

#include "files/json_fields.h"

namespace pleinair::devices {
namespace {

constexpr int kMaxFrames = 100'000'000;
constexpr double kMaxRate_hz = 1e5;
constexpr double kMaxStamp_s = 1e9;  // 30 years: still exact to nanoseconds in 64 bits.

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
    return fields.Fail("frame_count", "is not a number of frames", "count from 1");
  }
  PLEINAIR_ASSIGN_OR_RETURN(manifest.frame_rate_hz, fields.Number(rate_key));
  if (manifest.frame_rate_hz &&
      (*manifest.frame_rate_hz <= 0.0 || *manifest.frame_rate_hz > kMaxRate_hz)) {
    return fields.Fail(rate_key, "is no frame rate", "frames a second, greater than zero");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::vector<double>> stamps,
                            fields.Numbers("timestamps_s"));
  manifest.timestamps_s = stamps.value_or(std::vector<double>());
  for (std::size_t i = 0; i < manifest.timestamps_s.size(); ++i) {
    if (std::fabs(manifest.timestamps_s[i]) > kMaxStamp_s ||
        (i > 0 && manifest.timestamps_s[i] <= manifest.timestamps_s[i - 1])) {
      return fields.Fail("timestamps_s", "does not ascend at frame " + std::to_string(i),
                         "each time stamp must be later than the one before, in seconds");
    }
  }
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
