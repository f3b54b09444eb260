#include "compositor/light/sun_transmittance_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "base/bilinear.h"
#include "base/quantile.h"
#include "base/units.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

constexpr double kCellPx = 2.0;  // About the distance between surface samples.
constexpr int kWidest = 512;
// Share of the surface samples that is excluded at either end of each axis, because distant ground
// spreads them thinly.
constexpr double kOutside = 0.01;
// Weight of the neighbourhood's mean, relative to one surface sample. It is the only weight in a
// cell without samples.
constexpr double kNeighbours = 0.25;
// Within this angle, the shadow of leaves ten metres away moves half a metre. That is the size of
// the gaps in a tree's crown.
constexpr double kMaxSunAngle_rad = 3.0 * kRadiansPerDegree;

/// Sums and weights per cell.
struct Level {
  int width = 0, height = 0;
  std::vector<double> sum, weight;
  Level(int w, int h) : width(w), height(h), sum(Size()), weight(Size()) {}
  std::size_t Size() const { return static_cast<std::size_t>(width) * height; }
  std::size_t At(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Mean of each cell; a cell without surface samples takes its neighbourhood's mean. Pull-push
/// (Gortler et al., The Lumigraph, 1996, section 3.3.2).
std::vector<double> FillGaps(const Level& level) {
  if (level.Size() == 1) return {level.sum[0] / level.weight[0]};
  Level coarse((level.width + 1) / 2, (level.height + 1) / 2);
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x) {
      coarse.sum[coarse.At(x / 2, y / 2)] += level.sum[level.At(x, y)];
      coarse.weight[coarse.At(x / 2, y / 2)] += level.weight[level.At(x, y)];
    }
  }
  const std::vector<double> about = FillGaps(coarse);
  // Bilinear between the middles of the coarser cells, so that their edges are invisible.
  const auto about_at = [&](int x, int y) {
    const auto halves = [](int fine, int cells) {
      const double at = std::clamp((fine + 0.5) / 2 - 0.5, 0.0, cells - 1.0);
      const int low = static_cast<int>(at);
      return std::tuple{low, std::min(low + 1, cells - 1), at - low};
    };
    const auto [left, right, u] = halves(x, coarse.width);
    const auto [top, bottom, v] = halves(y, coarse.height);
    return (1 - v) * ((1 - u) * about[coarse.At(left, top)] + u * about[coarse.At(right, top)]) +
           v * ((1 - u) * about[coarse.At(left, bottom)] + u * about[coarse.At(right, bottom)]);
  };
  std::vector<double> filled(level.Size());
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x) {
      const std::size_t i = level.At(x, y);
      filled[i] = (level.sum[i] + kNeighbours * about_at(x, y)) / (level.weight[i] + kNeighbours);
    }
  }
  return filled;
}

}  // namespace

double SunTransmittanceMap::At(Vec3 point) const {
  if (share.empty()) return 1.0;
  return BilinearAt(share, width, height, (Dot(point, across_x) - first_x) / cell_m,
                    (Dot(point, across_y) - first_y) / cell_m);
}

bool SunTransmittanceMap::HoldsFor(Vec3 direction) const {
  return Dot(direction, to_sun) >= std::cos(kMaxSunAngle_rad);
}

std::array<std::array<float, 4>, 2> SunTransmittanceMap::TextureFromMarker() const {
  const auto row = [&](Vec3 across, double first, int cells) {
    const double scale = 1.0 / (cell_m * cells);
    return std::array{static_cast<float>(across.x * scale), static_cast<float>(across.y * scale),
                      static_cast<float>(across.z * scale),
                      static_cast<float>(0.5 / cells - first * scale)};
  };
  return {row(across_x, first_x, width), row(across_y, first_y, height)};
}

SunTransmittanceMap BuildSunTransmittanceMap(Vec3 to_sun,
                                             std::span<const SunlitSample> surface_samples) {
  SunTransmittanceMap map;
  if (surface_samples.empty()) return map;
  const TangentFrame sun(Normalized(to_sun));
  map.to_sun = sun.normal;
  map.across_x = sun.tangent;
  map.across_y = sun.bitangent;
  std::vector<double> xs, ys, footprints;
  for (const SunlitSample& surface_sample : surface_samples) {
    xs.push_back(Dot(surface_sample.point, map.across_x));
    ys.push_back(Dot(surface_sample.point, map.across_y));
    footprints.push_back(surface_sample.footprint_m);
  }
  map.first_x = Quantile(xs, kOutside);
  map.first_y = Quantile(ys, kOutside);
  const double wide = Quantile(xs, 1 - kOutside) - map.first_x;
  const double high = Quantile(ys, 1 - kOutside) - map.first_y;
  map.cell_m =
      std::max({kCellPx * Quantile(footprints, 0.5), std::max(wide, high) / (kWidest - 1), 1e-4});
  map.width = static_cast<int>(wide / map.cell_m) + 1;
  map.height = static_cast<int>(high / map.cell_m) + 1;
  Level level(map.width, map.height);
  for (std::size_t i = 0; i < surface_samples.size(); ++i) {
    const auto x = std::lround((xs[i] - map.first_x) / map.cell_m);
    const auto y = std::lround((ys[i] - map.first_y) / map.cell_m);
    if (x < 0 || y < 0 || x >= map.width || y >= map.height) continue;
    const std::size_t cell = level.At(static_cast<int>(x), static_cast<int>(y));
    level.sum[cell] += surface_samples[i].share;
    level.weight[cell] += 1.0;
  }
  // A few surface samples may lie in opposite corners, outside the box of the quantiles.
  if (std::none_of(level.weight.begin(), level.weight.end(), [](double w) { return w > 0.0; })) {
    return SunTransmittanceMap{};
  }
  const std::vector<double> filled = FillGaps(level);
  map.share.assign(filled.begin(), filled.end());
  return map;
}

}  // namespace pleinair::compositor
