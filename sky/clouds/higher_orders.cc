#include "sky/clouds/higher_orders.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "sky/clouds/cloud_phase.h"
#include "sky/gauss_rule.h"
#include "sky/henyey_greenstein.h"

namespace pleinair::clouds {
namespace {

using std::numbers::pi;

/// Depths 2^(k/2 − 5): 1/32 to 512.
constexpr double kFirstOctaveDepth = 1.0 / 32.0;
constexpr int kSectors = 16;

/// (e^(−a) − e^(−b)) / (b − a), also where both are equal.
double MeanExponential(double a, double b) {
  const double difference = b - a;
  if (std::fabs(difference) < 1e-6) return std::exp(-0.5 * (a + b));
  return -std::exp(-a) * std::expm1(-difference) / difference;
}

struct Fluxes {
  double down = 0.0, up = 0.0;
};

/// Fluxes of the first scattering for unit sunlight on a surface that faces the sun. Integrated
/// about the sun, because the phase function has a narrow peak there.
Fluxes FirstScattering(CloudKind kind, double depth, double sun_cosine) {
  constexpr int kRings = 120;
  const double sun_sine = std::sqrt(std::max(0.0, 1.0 - sun_cosine * sun_cosine));
  Fluxes fluxes;
  double norm = 0.0;
  for (int ring = 0; ring < kRings; ++ring) {
    const double x = (ring + 0.5) / kRings;
    const double angle = pi * x * x * x;
    const double solid = 3.0 * pi * x * x / kRings * std::sin(angle) / kSectors * 2.0 * pi;
    const double light = CloudPhase(kind, std::cos(angle)) * solid / (4.0 * pi);
    norm += light * kSectors;
    for (int sector = 0; sector < kSectors; ++sector) {
      const double about = 2.0 * pi * (sector + 0.5) / kSectors;
      const double down =
          sun_cosine * std::cos(angle) + sun_sine * std::sin(angle) * std::cos(about);
      const double cosine = std::max(1e-4, std::fabs(down));
      if (down > 0.0) {
        fluxes.down += light * depth * MeanExponential(depth / sun_cosine, depth / cosine);
      } else {
        fluxes.up += light * depth * MeanExponential(0.0, depth / sun_cosine + depth / cosine);
      }
    }
  }
  return {fluxes.down / norm, fluxes.up / norm};
}

}  // namespace

HigherOrders::HigherOrders(CloudKind kind, double sun_cosine)
    : asymmetry_(kind == CloudKind::kCirrus ? kIceAsymmetry : kWaterAsymmetry),
      sun_cosine_(std::clamp(sun_cosine, SlabTable::kMinCosine, 1.0)) {
  const SlabTable& table = kind == CloudKind::kCirrus ? SlabTable::Ice() : SlabTable::Water();
  for (int i = 0; i < kDepths; ++i) {
    scales_[static_cast<std::size_t>(i)] =
        SolveScale(kind, table, kFirstOctaveDepth * std::exp2(0.5 * i));
  }
}

HigherOrders::Phases HigherOrders::PhasesAt(double cosine) const {
  Phases phases{};
  double factor = 1.0;
  for (double& phase : phases) {
    factor *= 0.5;
    phase = factor * sky::HenyeyGreenstein(asymmetry_ * factor, cosine);
  }
  return phases;
}

// Two equations for the two ends of k: the downward and the upward flux.
HigherOrders::Scale HigherOrders::SolveScale(CloudKind kind, const SlabTable& table,
                                             double depth) const {
  constexpr int kDirections = 12, kPieces = 32;
  static const sky::GaussRule directions = sky::GaussOnUnitInterval(kDirections);
  static const sky::GaussRule pieces = sky::GaussOnUnitInterval(kPieces);
  const double sun_sine = std::sqrt(1.0 - sun_cosine_ * sun_cosine_);
  Fluxes lit, shaded;  // Those of octaves with the weights 1 − s and s.
  for (int i = 0; i < kDirections; ++i) {
    const double cosine = directions.nodes[i];
    const double sine = std::sqrt(1.0 - cosine * cosine);
    Phases down{}, up{};
    for (int sector = 0; sector < kSectors; ++sector) {
      const double across = sine * sun_sine * std::cos(2.0 * pi * (sector + 0.5) / kSectors);
      const Phases d = PhasesAt(across + cosine * sun_cosine_);
      const Phases u = PhasesAt(across - cosine * sun_cosine_);
      for (std::size_t n = 0; n < kOctaves; ++n) {
        down[n] += d[n] / kSectors;
        up[n] += u[n] / kSectors;
      }
    }
    for (int j = 0; j < kPieces; ++j) {
      // Denser at both faces, where thick layers change most.
      const double x = pieces.nodes[j];
      const double share = x * x * (3.0 - 2.0 * x);
      const double weight = 2.0 * pi * directions.weights[i] * pieces.weights[j] * 6.0 * x *
                            (1.0 - x) * depth / (4.0 * pi);
      double light_down = 0.0, light_up = 0.0;
      double factor = 1.0;
      for (std::size_t n = 0; n < kOctaves; ++n) {
        factor *= 0.5;
        const double sunlight = std::exp(-factor * share * depth / sun_cosine_);
        light_down += down[n] * sunlight;
        light_up += up[n] * sunlight;
      }
      light_down *= weight * std::exp(-(1.0 - share) * depth / cosine);
      light_up *= weight * std::exp(-share * depth / cosine);
      lit.down += (1.0 - share) * light_down;
      lit.up += (1.0 - share) * light_up;
      shaded.down += share * light_down;
      shaded.up += share * light_up;
    }
  }
  const Fluxes first = FirstScattering(kind, depth, sun_cosine_);
  const double reflected = table.Reflected(depth, sun_cosine_);
  const double down =
      std::max(0.0, sun_cosine_ * (1.0 - reflected - Unscattered(depth, sun_cosine_)) - first.down);
  const double up = std::max(0.0, sun_cosine_ * reflected - first.up);
  const double determinant = lit.down * shaded.up - shaded.down * lit.up;
  const Scale scale{(down * shaded.up - shaded.down * up) / determinant,
                    (lit.down * up - down * lit.up) / determinant};
  if (scale.lit >= 0.0 && scale.shaded >= 0.0) return scale;
  // The downward flux is the one that is seen.
  const double common = down / (lit.down + shaded.down);
  return {common, common};
}

HigherOrders::Scale HigherOrders::ScaleOf(double column) const {
  const double place =
      std::clamp(2.0 * std::log2(std::max(column, 1e-9) / kFirstOctaveDepth), 0.0, kDepths - 1.0);
  const auto cell = std::min(static_cast<std::size_t>(place), std::size_t{kDepths - 2});
  const double part = place - static_cast<double>(cell);
  const Scale &a = scales_[cell], &b = scales_[cell + 1];
  return {a.lit + part * (b.lit - a.lit), a.shaded + part * (b.shaded - a.shaded)};
}

double HigherOrders::Source(const Phases& phases, double sun_depth, double column) const {
  const Scale scale = ScaleOf(column);
  const double share = std::clamp(sun_depth * sun_cosine_ / std::max(column, 1e-9), 0.0, 1.0);
  // Each octave's transmittance is the square root of the one before.
  double sunlight = std::exp(-sun_depth / (1 << kOctaves));
  double sum = 0.0;
  for (std::size_t n = kOctaves; n-- > 0; sunlight *= sunlight) sum += phases[n] * sunlight;
  return (scale.lit + share * (scale.shaded - scale.lit)) * sum / (4.0 * pi);
}

}  // namespace pleinair::clouds
