#include "sky/clouds/layer_march.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/parallel_for.h"
#include "sky/clouds/cloud_phase.h"

namespace pleinair::clouds {
namespace {

constexpr int kFluxRays = 4096;
constexpr int kFluxRows = 64;  // Rays are marched by rows, in parallel.

double FractionOf(double value) { return value - std::floor(value); }

/// The i-th place of a sequence that fills the unit square evenly (Roberts 2018, R2).
Vec2 EvenPlace(int i) {
  return {FractionOf(0.5 + 0.7548776662466927 * i), FractionOf(0.5 + 0.5698402909980532 * i)};
}

/// Means over the area of the light that a layer scatters downwards, over E_sun.
struct ScatteredDown {
  double first = 0.0, higher = 0.0;
};

ScatteredDown FluxesOf(const CloudField& field, const HigherOrders& higher, Vec3 sun) {
  using std::numbers::pi;
  const double side = std::max(kCoverSquare_m, 3.0 * field.layer().cell_m);
  const Vec3 across = sun.z < 0.999 ? Normalized(Cross(sun, {0.0, 0.0, 1.0})) : Vec3{1.0, 0.0, 0.0};
  const Vec3 upwards = Cross(across, sun);
  constexpr double kMinRise = 0.01;
  std::array<ScatteredDown, kFluxRows> rows;
  ParallelFor(kFluxRows, 0, [&](std::size_t row) {
    for (int i = static_cast<int>(row); i < kFluxRays; i += kFluxRows) {
      const Vec2 place = EvenPlace(i);
      const Vec3 from{place.x * side, place.y * side, 0.0};
      // Strata of the direction, shifted from those of the place.
      const double x = (i + 0.5) / kFluxRays, about = 2.0 * pi * FractionOf(0.6180339887498949 * i);
      // Uniform over the projected hemisphere.
      const double level = std::sqrt(x);
      const Vec3 any{level * std::cos(about), level * std::sin(about), std::sqrt(1.0 - x)};
      if (any.z > kMinRise) {
        rows[row].higher += pi * MarchLayer(field, higher, from, any, sun, true, 0.0).higher;
      }
      // About the sun, denser towards it, because the phase function has a narrow peak there.
      const double angle = pi * x * x * x;
      const Vec3 near_sun = sun * std::cos(angle) + across * (std::sin(angle) * std::cos(about)) +
                            upwards * (std::sin(angle) * std::sin(about));
      if (near_sun.z > kMinRise) {
        const double solid_angle = 6.0 * pi * pi * x * x * std::sin(angle);
        rows[row].first += solid_angle * near_sun.z *
                           MarchLayer(field, higher, from, near_sun, sun, true, 0.0).first;
      }
    }
  });
  ScatteredDown sum;
  for (const ScatteredDown& row : rows) {
    sum.first += row.first / kFluxRays;
    sum.higher += row.higher / kFluxRays;
  }
  return sum;
}

}  // namespace

LayerRay MarchLayer(const CloudField& field, const HigherOrders& higher, Vec3 from_m, Vec3 view,
                    Vec3 to_sun, bool lit, double seconds) {
  constexpr int kSunSteps = 6;
  const double cosine = Dot(view, to_sun);
  const double first_phase = CloudPhase(field.layer().kind, cosine) / (4.0 * std::numbers::pi);
  const HigherOrders::Phases phases = higher.PhasesAt(cosine);
  LayerRay ray;
  double transmitted = 1.0;
  field.March(from_m, view, seconds, [&](double depth, Vec3 middle, double column, double length) {
    ray.depth += depth;
    if (!ray.cloud_m) ray.cloud_m = middle;
    if (!lit || transmitted < 1e-4) return;
    // Light leaves a piece from where the mean photon does: near its lower end if it is dense.
    const double where = depth < 1e-3 ? 0.5 : 1.0 / depth - 1.0 / std::expm1(depth);
    const Vec3 place = middle + view * ((where - 0.5) * length);
    const double sun_depth = field.DepthAlong(place, to_sun, seconds, kSunSteps);
    const double kept = std::exp(-depth);
    const double scattered = transmitted * (1.0 - kept);
    ray.first += scattered * first_phase * std::exp(-sun_depth);
    ray.higher += scattered * higher.Source(phases, sun_depth, column);
    transmitted *= kept;
  });
  return ray;
}

double MeanHigherScale(const CloudField& field, const HigherOrders& higher, Vec3 to_sun,
                       double diffuse_down) {
  // Below that the sun lights no layer from above.
  constexpr double kMinSine = 0.02;
  if (to_sun.z < kMinSine || field.layer().kind == CloudKind::kSlab) return 1.0;
  const ScatteredDown down = FluxesOf(field, higher, to_sun);
  if (down.higher <= 0.0) return 1.0;
  return std::max(0.0, diffuse_down - down.first) / down.higher;
}

}  // namespace pleinair::clouds
