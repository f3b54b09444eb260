#include "session/camera_look_filter.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/quantile.h"

namespace pleinair::session {
namespace {

using compositor::CameraLook;

// Interval of measurements in frames, and number of measurements in a median.
constexpr int kStep = 5;
constexpr std::size_t kWindow = 5;

CameraLook MedianLook(const std::deque<CameraLook>& looks) {
  const auto median = [&](const auto& value) {
    std::vector<double> values(looks.size());
    std::transform(looks.begin(), looks.end(), values.begin(), value);
    return Median(std::move(values));
  };
  CameraLook look;
  look.blur_px = median([](const CameraLook& l) { return l.blur_px; });
  for (int c = 0; c < 3; ++c) {
    look.noise_constant[c] = median([c](const CameraLook& l) { return l.noise_constant[c]; });
    look.noise_slope[c] = median([c](const CameraLook& l) { return l.noise_slope[c]; });
  }
  look.neighbour_correlation = median([](const CameraLook& l) { return l.neighbour_correlation; });
  look.channel_correlation = median([](const CameraLook& l) { return l.channel_correlation; });
  return look;
}

}  // namespace

std::optional<CameraLook> CameraLookFilter::Update(
    ImageView<const std::uint8_t> rgb, const CameraModel& camera,
    const Transform<Camera, Marker>& camera_from_marker, const scene::MarkerReflectance& marker,
    const CameraResponse& response, const std::optional<compositor::ThinLens>& lens,
    const compositor::CameraMotion& motion) {
  if (frames_to_next_-- > 0) return std::nullopt;
  const auto measured = compositor::MeasureCameraLook(rgb, camera, camera_from_marker, marker,
                                                      response, lens, motion);
  if (!measured) return std::nullopt;
  frames_to_next_ = kStep - 1;
  recent_.push_back(*measured);
  if (recent_.size() > kWindow) recent_.pop_front();
  return MedianLook(recent_);
}

}  // namespace pleinair::session
