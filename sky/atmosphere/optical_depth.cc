#include "sky/atmosphere/optical_depth.h"

#include <algorithm>
#include <cmath>

#include "sky/sun/solar_disc.h"

namespace pleinair::sky {
namespace {

constexpr double kGround = AirMedium::kGroundRadius, kTop = AirMedium::kTopRadius;

/// Distance from the ground to space along the horizontal.
const double kHorizonToTop = std::sqrt(kTop * kTop - kGround * kGround);

double DistanceToTop(double radius, double mu) {
  return -radius * mu + std::sqrt(std::max(0.0, radius * radius * (mu * mu - 1.0) + kTop * kTop));
}

}  // namespace

OpticalDepthTable::OpticalDepthTable(const AirMedium& medium)
    : medium_(medium), table_(static_cast<std::size_t>(kHeights) * kDirections) {
  for (int row = 0; row < kHeights; ++row) {
    const double rho = kHorizonToTop * row / (kHeights - 1);
    const double radius = std::sqrt(rho * rho + kGround * kGround);
    const double nearest = kTop - radius;
    const double farthest = DistanceToTop(radius, 0.0);
    for (int column = 0; column < kDirections; ++column) {
      const double length = std::lerp(nearest, farthest, column / (kDirections - 1.0));
      // Zenith cosine of the ray that reaches space after this distance.
      const double mu = length > 0.0
                            ? std::clamp((kTop * kTop - radius * radius - length * length) /
                                             (2.0 * radius * length),
                                         0.0, 1.0)
                            : 1.0;
      // Midpoint rule in t, distance = length · t³: denser steps where the air is denser.
      constexpr int kSteps = 32;
      double molecules = 0.0, aerosol = 0.0, ozone = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double t = (i + 0.5) / kSteps;
        const double s = length * t * t * t;
        const double weight = length * 3.0 * t * t / kSteps;
        const double height = std::sqrt(radius * radius + s * s + 2.0 * radius * mu * s) - kGround;
        const AirMedium::Densities d = medium.DensitiesAt(height);
        molecules += weight * d.molecules;
        aerosol += weight * d.aerosol;
        ozone += weight * d.ozone;
      }
      table_[static_cast<std::size_t>(row) * kDirections + column] = {
          static_cast<float>(molecules), static_cast<float>(aerosol), static_cast<float>(ozone)};
    }
  }
}

Spectrum OpticalDepthTable::Upward(double radius, double mu) const {
  const double rho = std::sqrt(std::max(0.0, radius * radius - kGround * kGround));
  const double nearest = kTop - radius;
  const double farthest = DistanceToTop(radius, 0.0);
  const double along =
      farthest > nearest ? (DistanceToTop(radius, mu) - nearest) / (farthest - nearest) : 0.0;
  const double row = std::clamp(rho / kHorizonToTop, 0.0, 1.0) * (kHeights - 1);
  const double column = std::clamp(along, 0.0, 1.0) * (kDirections - 1);
  const int r = std::min(static_cast<int>(row), kHeights - 2);
  const int c = std::min(static_cast<int>(column), kDirections - 2);
  const auto fr = static_cast<float>(row - r), fc = static_cast<float>(column - c);
  const Columns* near = &table_[static_cast<std::size_t>(r) * kDirections + c];
  const Columns* far = near + kDirections;
  const auto blend = [&](float Columns::*m) {
    const float low = near[0].*m + (near[1].*m - near[0].*m) * fc;
    const float high = far[0].*m + (far[1].*m - far[0].*m) * fc;
    return low + (high - low) * fr;
  };
  Spectrum depth = medium_.molecules * blend(&Columns::molecules);
  depth.AddScaled(medium_.aerosol_extinction, blend(&Columns::aerosol));
  depth.AddScaled(medium_.ozone, blend(&Columns::ozone));
  return depth;
}

Spectrum OpticalDepthTable::ToSpace(double height_m, double mu) const {
  const double radius = std::clamp(kGround + height_m, kGround, kTop);
  if (mu >= 0.0) return Upward(radius, mu);
  // The lowest point of the ray, no lower than the ground.
  const double lowest = std::max(kGround, radius * std::sqrt(std::max(0.0, 1.0 - mu * mu)));
  const double grazing = std::sqrt(std::max(0.0, 1.0 - (lowest / radius) * (lowest / radius)));
  const Spectrum half = Upward(lowest, 0.0);
  Spectrum depth = half + half - Upward(radius, grazing);
  for (float& value : depth.v) value = std::max(value, 0.0F);
  return depth;
}

Spectrum OpticalDepthTable::SunTransmittance(double height_m, double mu) const {
  const double radius = std::clamp(kGround + height_m, kGround, kTop);
  const double dip = -std::acos(std::min(1.0, kGround / radius));
  const double above = std::asin(std::clamp(mu, -1.0, 1.0)) - dip;
  const double share = DiscShareAboveHorizon(Radians(above));
  if (share <= 0.0) return {};
  return Transmittance(ToSpace(height_m, mu)) * static_cast<float>(share);
}

}  // namespace pleinair::sky
