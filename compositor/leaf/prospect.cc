#include "compositor/leaf/prospect.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "compositor/leaf/prospect_pigments.h"
#include "compositor/leaf/prospect_tissue.h"
#include "compositor/leaf/prospect_water.h"

namespace pleinair::compositor {
namespace {

// Half-angle of the cone from which light meets the rough surface of a leaf (Jacquemoud & Baret
// 1990 and later versions).
constexpr double kLeafConeDeg = 40.0;

template <std::size_t kCount>
double ValueOrZero(const std::array<double, kCount>& values, std::size_t i) {
  return i < kCount ? values[i] : 0.0;
}

LeafBand MakeLeafBand(std::size_t i) {
  const double refractive_index = 1e-4 * prospect_d::kRefractiveIndex[i];
  LeafBand band;
  band.absorption = {ValueOrZero(prospect_d::kChlorophyll, i),
                     ValueOrZero(prospect_d::kCarotenoids, i),
                     ValueOrZero(prospect_d::kAnthocyanins, i),
                     ValueOrZero(prospect_d::kBrown, i),
                     prospect_d::kWater[i],
                     prospect_d::kDryMatter[i]};
  band.first = PlateSurfaceOf(FromDegrees(kLeafConeDeg), refractive_index);
  band.inner = PlateSurfaceOf(FromDegrees(90.0), refractive_index);
  return band;
}

const std::vector<LeafBand>& LeafBandTable() {
  static const std::vector<LeafBand> kTable = [] {
    std::vector<LeafBand> table(kLeafBands);
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = MakeLeafBand(i);
    return table;
  }();
  return kTable;
}

}  // namespace

const LeafBand& LeafBandAt(int wavelength_nm) {
  return LeafBandTable()[static_cast<std::size_t>(wavelength_nm - kFirstLeafNm)];
}

LeafBand InterpolatedLeafBand(double wavelength_nm) {
  const double place = std::clamp(wavelength_nm - kFirstLeafNm, 0.0, kLeafBands - 1.0);
  const int lower = std::min(static_cast<int>(place), kLeafBands - 2);
  const double t = place - lower;
  const LeafBand& a = LeafBandAt(kFirstLeafNm + lower);
  const LeafBand& b = LeafBandAt(kFirstLeafNm + lower + 1);
  LeafBand band;
  for (std::size_t i = 0; i < kLeafConstituents; ++i) {
    band.absorption[i] = std::lerp(a.absorption[i], b.absorption[i], t);
  }
  const auto mixed = [t](const PlateSurface& x, const PlateSurface& y) {
    return PlateSurface{std::lerp(x.entering, y.entering, t), std::lerp(x.diffuse, y.diffuse, t),
                        std::lerp(x.n2, y.n2, t)};
  };
  band.first = mixed(a.first, b.first);
  band.inner = mixed(a.inner, b.inner);
  return band;
}

double OpticalDepth(const LeafBand& band, const scene::LeafContents& contents) {
  return band.absorption[0] * contents.chlorophyll_ug_cm2 +
         band.absorption[1] * contents.carotenoids_ug_cm2 +
         band.absorption[2] * contents.anthocyanins_ug_cm2 + band.absorption[3] * contents.brown +
         band.absorption[4] * contents.water_cm + band.absorption[5] * contents.dry_g_cm2;
}

LeafOptics StackOptics(const LeafBand& band, double optical_depth, double structure) {
  const double theta = LayerTransmittance(optical_depth / structure);
  const LeafOptics first = PlateOptics(band.first, theta);
  const auto [r, t] = PlateOptics(band.inner, theta);
  // Optics of the other N − 1 plates.
  LeafOptics others;
  constexpr double kNoAbsorption = 1e-12;
  const double absorbed = 1.0 - r - t;
  if (absorbed < kNoAbsorption) {
    others.transmittance = t / (t + (1.0 - t) * (structure - 1.0));
    others.reflectance = 1.0 - others.transmittance;
  } else {
    const double r2 = r * r, t2 = t * t;
    const double delta = std::sqrt((1.0 + r + t) * (1.0 + r - t) * (1.0 - r + t) * absorbed);
    const double a = (1.0 + r2 - t2 + delta) / (2.0 * r);
    const double beta = std::pow(2.0 * t / (1.0 - r2 + t2 + delta), structure - 1.0);
    const double share = 1.0 / (a * a - beta * beta);
    others.reflectance = a * (1.0 - beta * beta) * share;
    others.transmittance = beta * (a * a - 1.0) * share;
  }
  const double between = first.transmittance / (1.0 - others.reflectance * r);
  return {first.reflectance + between * others.reflectance * t, between * others.transmittance};
}

}  // namespace pleinair::compositor
