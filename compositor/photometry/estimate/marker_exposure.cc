#include "compositor/photometry/estimate/marker_exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pleinair::compositor {
namespace {

// One standard deviation of the marker's reflectances and of the model's light on it, logarithmic.
constexpr double kWhiteError = 0.05;
// Shares of the sun that stand for half-light.
constexpr std::array kHalfLight{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
// What a caster hides of the sky, over its mean share.
constexpr std::array kPartsOfTaken{0.0, 0.5, 1.0, 1.5, 2.0};
// Probability that a marker lies in the open whatever the share of shade around it, and the other
// way round. Probability of a dappled marker in even sun, over that in shade.
constexpr double kAnyway = 0.05, kDappledInSun = 0.2;

}  // namespace

MarkerExposure::MarkerExposure(const MarkerLight& marker, LinearRgb sky, LinearRgb sun,
                               double shaded, double taken)
    : known_(Luminance(marker.predicted) > 0.0), sky_(sky), sun_(sun), taken_(taken) {
  if (known_) predicted_ = MeanLog(marker.predicted);
  if (Luminance(sun) <= 0.0) return;
  open_ = kAnyway + (1 - 2 * kAnyway) * (1 - shaded);
  dark_ = 0.5 * (1 - open_);
  half_ = 0.5 * (1 - open_) / kHalfLight.size();
  if (marker.dappled) open_ *= kDappledInSun;
}

double MarkerExposure::Density(double e, LinearRgb light) const {
  const double z = (e - predicted_ + MeanLog(light)) / kWhiteError;
  return std::exp(-0.5 * z * z) / (kWhiteError * std::sqrt(2 * std::numbers::pi));
}

double MarkerExposure::ShadedDensity(double e) const {
  double sum = 0.0;
  for (const double part : kPartsOfTaken) {
    const LinearRgb sky = sky_ * (1 - part * taken_);
    sum += dark_ * Density(e, sky);
    for (const double share : kHalfLight) sum += half_ * Density(e, sky + sun_ * share);
  }
  return sum / kPartsOfTaken.size();
}

double MarkerExposure::LogPrior(double e) const {
  if (!known_) return -std::log(LevelGrid::kCount * LevelGrid::kStep);
  const double sum = open_ * Density(e, sky_ + sun_) + ShadedDensity(e);
  return std::log(std::max(sum, 1e-300));
}

double MarkerExposure::LogShade(double e) const {
  if (!known_ || Luminance(sun_) <= 0.0) return 0.0;
  if (open_ * Density(e, sky_ + sun_) > ShadedDensity(e)) return 0.0;
  return std::max(0.0, e - predicted_ + MeanLog(sky_ + sun_));
}

}  // namespace pleinair::compositor
