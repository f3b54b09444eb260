#include "compositor/photometry/shadow_side.h"

namespace pleinair::compositor {
namespace {

constexpr int kDiscDirections = 8;  // On the rim of the sun's disc, besides its centre.
constexpr double kRim = 0.98;       // Their distance from its centre, in radii.
constexpr double kBlurPx = 1.5;     // Samples nearer to an edge than this mix both sides.

}  // namespace

ShadowSide ShadowSideOf(const PhantomRays& phantoms, const SurfaceSample& sample,
                        const TangentFrame& to_sun) {
  const bool lit = phantoms.IsUnoccluded(sample.point, to_sun.normal);
  for (int i = 0; i < kDiscDirections; ++i) {
    const Vec3 direction =
        SunDiscDirection(to_sun, {kRim * kRim, static_cast<double>(i) / kDiscDirections});
    if (phantoms.IsUnoccluded(sample.point, direction) != lit) return ShadowSide::kNeither;
  }
  const TangentFrame around(sample.normal);
  const double step = kBlurPx * sample.footprint_m;
  for (const Vec3 aside : {around.tangent, -around.tangent, around.bitangent, -around.bitangent}) {
    const Point<Marker> beside{sample.point.xyz + aside * step};
    if (phantoms.IsUnoccluded(beside, to_sun.normal) != lit) return ShadowSide::kNeither;
  }
  return lit ? ShadowSide::kLit : ShadowSide::kShaded;
}

}  // namespace pleinair::compositor
