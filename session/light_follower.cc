#include "session/light_follower.h"

#include <algorithm>

#include "base/quantile.h"

namespace pleinair::session {
namespace {

// Logarithm of the sun below its nearly largest value at which a frame still has the full sun.
constexpr double kFullSun = 0.1;
// Quantile that stands for the largest value.
constexpr double kLargest = 0.9;

}  // namespace

void LightFollower::Add(CameraImageView image, const Transform<Camera, Marker>& pose,
                        const scene::MarkerReflectance& marker, std::int64_t frame_index,
                        std::int64_t timestamp_ns) {
  probes_.AddFrame(image, pose, marker, frame_index, timestamp_ns);
}

void LightFollower::Fit(const sky::SkyModel& day, const Mat3& marker_from_world,
                        const std::set<std::int64_t>& reference) {
  lights_ = compositor::LightOn(probes_.probes(), phantoms_, day, marker_from_world);
  to_sun_ = Normalized(marker_from_world * day.ToSun().xyz);
  std::vector<std::size_t> indices;
  const auto& frames = probes_.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (reference.contains(frames[i].frame_index)) indices.push_back(i);
  }
  changes_ = compositor::FitLightChanges(frames, probes_.probes(), lights_, indices);
  on_marker_ = {};
  for (std::size_t i = 0; i < lights_.size(); ++i) on_marker_.Add(probes_.probes()[i], lights_[i]);
}

compositor::ResponseEstimate LightFollower::EstimateResponse(
    const std::set<std::int64_t>& frames) const {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < probes_.frames().size(); ++i) {
    if (frames.contains(probes_.frames()[i].frame_index)) indices.push_back(i);
  }
  return compositor::FitResponse(compositor::CollectResponseChart(
      probes_.frames(), indices, probes_.probes(), lights_, phantoms_, to_sun_));
}

std::set<std::int64_t> LightFollower::FramesInFullSun() const {
  std::vector<double> suns;
  suns.reserve(frames().size());
  // Relative to the sky, so that the exposure does not matter.
  for (const auto& frame : frames()) suns.push_back(frame.LogRatio());
  std::set<std::int64_t> chosen;
  if (suns.empty()) return chosen;
  const double full = Quantile(suns, kLargest) - kFullSun;
  for (const auto& frame : frames()) {
    if (frame.LogRatio() >= full) chosen.insert(frame.frame_index);
  }
  return chosen;
}

FollowedLight LightFollower::Of(std::int64_t frame_index) const {
  const auto found = std::lower_bound(
      frames().begin(), frames().end(), frame_index,
      [](const auto& frame, std::int64_t index) { return frame.frame_index < index; });
  FollowedLight light;
  if (found == frames().end() || found->frame_index != frame_index) return light;
  light.log_ratio_error = found->log_ratio_error;
  light.source = found->source;
  if (!changes_.changes) return light;
  light.exposure = found->sky;
  light.mix.sun = found->sun / found->sky;
  light.marker_light = on_marker_.Factor(found->sun, found->sky);
  return light;
}

}  // namespace pleinair::session
