#include "session/following/forward_follower.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compositor/photometry/changes/forward_light.h"
#include "session/following/light_on_marker.h"

namespace pleinair::session {
namespace {

// Probes that are lit in one go. Each takes about a millisecond.
constexpr std::size_t kProbesAtOnce = 128;
// Time over which the first change fades in, and the largest delay of a live light.
constexpr double kFadeIn_s = 0.2;
// Logarithm of sun over sky below its largest value, by more than its error, at which a frame still
// has the full sun.
constexpr double kFullSunReach = 0.1;
// Fall of that largest value, logarithm per second: the drift that LightFilter expects in a minute.
constexpr double kFullSunFall_per_s = 0.1 / 60.0;
// Time over which the sun of an estimate's frames is averaged: eight frames at 0.3 s.
constexpr double kEstimate_s = 2.4;

double ElapsedSeconds(std::int64_t from_ns, std::int64_t to_ns) {
  return 1e-9 * static_cast<double>(to_ns - from_ns);
}

LinearRgb Power(LinearRgb base, double exponent) {
  return {std::pow(base.r, exponent), std::pow(base.g, exponent), std::pow(base.b, exponent)};
}

}  // namespace

struct ForwardFollower::Stage {
  Stage(LightReference used, std::int64_t number_of, const CameraModel& camera,
        const CameraResponse& response)
      : reference(std::move(used)),
        number(number_of),
        probes(*reference.phantoms, camera, response) {}

  bool AllLit() const { return !probes.probes().empty() && lit == probes.probes().size(); }

  LightReference reference;
  std::int64_t number;
  compositor::LightProbes probes;
  compositor::ForwardLight forward;
  std::size_t lit = 0;                          // Probes with light.
  std::vector<compositor::ProbeLight> waiting;  // Lights of a stage that has not started.
  LightOnMarker on_marker;
};

void ForwardFollower::Deleter::operator()(Stage* stage) const { delete stage; }

void ForwardFollower::Use(LightReference reference) {
  if (next_) {
    reference.is_new_ratio |= next_->reference.is_new_ratio;
    reference.has_moved_phantoms |= next_->reference.has_moved_phantoms;
  }
  next_.reset(new Stage(std::move(reference), ++references_, camera_, response_));
}

void ForwardFollower::StartNext() {
  compositor::FrameLight start = newest_;
  if (current_) {
    if (next_->reference.is_new_ratio) {
      start.sun = start.sun * std::exp(-full_sun_.mean);
      full_sun_.largest -= full_sun_.mean;
      full_sun_.mean = 0.0;
    }
    next_->forward.Start(start);
    // The marker's brightness stays what it was.
    marker_light_ = marker_light_ * next_->on_marker.Factor(start.sun, start.sky) /
                    current_->on_marker.Factor(newest_.sun, newest_.sky);
  }
  for (const compositor::ProbeLight& light : next_->waiting) next_->forward.AddProbe(light);
  next_->waiting.clear();
  newest_ = start;
  current_ = std::move(next_);
}

void ForwardFollower::Add(CameraImageView image, const Transform<Camera, Marker>& pose,
                          const scene::MarkerReflectance& marker, std::int64_t frame_index,
                          std::int64_t timestamp_ns) {
  const auto probe = [&](Stage* stage) {
    stage->probes.AddFrame(image, pose, marker, frame_index, timestamp_ns);
    return stage->probes.TakeFrame();
  };
  if (next_ && next_->probes.probes().empty()) probe(next_.get());
  if (next_ && next_->AllLit() &&
      (!current_ || IsInFullSun() || next_->reference.has_moved_phantoms)) {
    StartNext();
  }
  if (!current_) return;
  const std::int64_t before_ns = newest_.timestamp_ns;
  newest_ = current_->forward.Add(probe(current_.get()));
  NoteSun(std::max(0.0, ElapsedSeconds(before_ns, timestamp_ns)));
  if (followed_since_ns_) return;
  steady_.Add(current_->on_marker.Factor(newest_.sun, newest_.sky), {});
  if (!current_->forward.changes()) return;
  followed_since_ns_ = before_ns;
  marker_light_ = steady_.ExposureScale();
}

void ForwardFollower::NoteSun(double seconds) {
  const double ratio = newest_.LogRatio();
  full_sun_.largest = std::max(full_sun_.largest - kFullSunFall_per_s * seconds, ratio);
  if (!IsInFullSun()) return;
  full_sun_.mean += std::min(1.0, seconds / kEstimate_s) * (ratio - full_sun_.mean);
}

std::optional<ProbesToLight> ForwardFollower::ProbesWithoutLight() const {
  const Stage* stage = next_ && !next_->AllLit() ? next_.get() : current_.get();
  if (stage == nullptr || stage->lit == stage->probes.probes().size()) return std::nullopt;
  const auto first = stage->probes.probes().begin() + static_cast<std::ptrdiff_t>(stage->lit);
  const std::size_t count = std::min(kProbesAtOnce, stage->probes.probes().size() - stage->lit);
  return ProbesToLight{
      stage->number, stage->reference, {first, first + static_cast<std::ptrdiff_t>(count)}};
}

void ForwardFollower::AddLights(std::int64_t reference,
                                const std::vector<compositor::ProbeLight>& lights) {
  Stage* stage = nullptr;
  for (Stage* one : {current_.get(), next_.get()}) {
    if (one != nullptr && one->number == reference) stage = one;
  }
  if (stage == nullptr) return;
  for (const compositor::ProbeLight& light : lights) {
    stage->on_marker.Add(stage->probes.probes()[stage->lit++], light);
    if (stage == current_.get()) {
      stage->forward.AddProbe(light);
    } else {
      stage->waiting.push_back(light);
    }
  }
}

FollowedLight ForwardFollower::Newest() const {
  FollowedLight light;
  light.log_ratio_error = newest_.log_ratio_error;
  light.source = newest_.source;
  if (!followed_since_ns_ || !current_) return light;
  const double weight =
      std::clamp(ElapsedSeconds(*followed_since_ns_, newest_.timestamp_ns) / kFadeIn_s, 0.0, 1.0);
  const LinearRgb one{1.0, 1.0, 1.0};
  light.mix.sun = Power(newest_.sun / newest_.sky, weight);
  light.marker_light = current_->on_marker.Factor(newest_.sun, newest_.sky) / marker_light_;
  // So that the marker has this light under the mix.
  light.exposure = light.marker_light / current_->on_marker.Factor(light.mix.sun, one);
  return light;
}

std::int64_t ForwardFollower::reference() const { return current_ ? current_->number : 0; }

bool ForwardFollower::IsInFullSun() const {
  return newest_.LogRatio() >= full_sun_.largest - kFullSunReach - newest_.log_ratio_error;
}

}  // namespace pleinair::session
