#include "compositor/photometry/estimate/light_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "base/parallel_for.h"
#include "base/quantile.h"
#include "compositor/light/sampling.h"
#include "compositor/light/scaled_sky.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kMaxCrossed = 120, kMaxSunny = 160, kMaxShaded = 48;
constexpr std::uint32_t kPaths = 192;
constexpr std::size_t kMinSamples = 12;  // Of a cell with one part.
constexpr std::size_t kMinPerSide = 5;   // Of each part where there are two.
constexpr int kDiscDirections = 8;       // On the rim of the sun's disc.
constexpr double kBlurPx = 1.5;          // Samples nearer to an edge mix both sides.
// A step: minimum share of the samples on each level; then the spread about the levels over their
// difference (a uniform distribution has 0.29): maximum, and the value of a sharp edge.
constexpr double kSideShare = 0.12, kTwoLevels = 0.24, kSharp = 0.13;
// Distance of the levels' centroids over the radius of all: sun and shade are not intermingled.
constexpr double kApart = 0.7;
// Logarithmic. Noise and mottling make smaller steps everywhere.
constexpr double kMinStep = 0.25;
constexpr double kOnePlane = 0.97;  // Cosine between normals (14°).

using Members = std::vector<std::uint32_t>;

/// True where the sample is clear of the end of a shadow, by the sun's width and the image's blur.
bool IsClear(const PhantomRays& phantoms, const SurfaceSample& sample, const TangentFrame& sun,
             bool lit) {
  constexpr double kRim = 0.98;
  for (int i = 0; i < kDiscDirections; ++i) {
    const Vec3 direction =
        SunDiscDirection(sun, {kRim * kRim, static_cast<double>(i) / kDiscDirections});
    if (phantoms.IsUnoccluded(sample.point, direction) != lit) return false;
  }
  const TangentFrame around(sample.normal);
  const double step = kBlurPx * sample.footprint_m;
  for (const Vec3 aside : {around.tangent, -around.tangent, around.bitangent, -around.bitangent}) {
    if (phantoms.IsUnoccluded({sample.point.xyz + aside * step}, sun.normal) != lit) return false;
  }
  return true;
}

CellPart PartOf(const SurfaceSamples& samples, std::span<const std::uint32_t> members) {
  CellPart part;
  std::vector<double> values(members.size());
  Vec3 middle;
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < members.size(); ++i)
      values[i] = samples.samples()[members[i]].log_rgb[c];
    part.log_rgb[c] = Median(values);
  }
  const auto count = static_cast<double>(members.size());
  for (std::size_t i = 0; i < members.size(); ++i) {
    values[i] = Brightness(samples.samples()[members[i]].log_rgb);
    middle = middle + samples.samples()[members[i]].point.xyz * (1.0 / count);
  }
  const double median = Median(values);
  for (double& value : values) value = std::fabs(value - median);
  // For a normal distribution: 1.4826 converts a median absolute deviation to a standard deviation,
  // π/2 is the variance of a median over that of a mean.
  const double sigma = 1.4826 * Median(values);
  part.variance = 1.571 * sigma * sigma / count;
  part.place =
      samples
          .samples()[*std::min_element(members.begin(), members.end(),
                                       [&](auto a, auto b) {
                                         return Norm(samples.samples()[a].point.xyz - middle) <
                                                Norm(samples.samples()[b].point.xyz - middle);
                                       })]
          .point;
  return part;
}

/// Every n-th of the cells, `most` at most.
std::vector<LightCell> Thinned(std::vector<LightCell> cells, std::size_t most) {
  if (cells.size() <= most) return cells;
  std::vector<LightCell> kept;
  for (std::size_t i = 0; i < most; ++i) kept.push_back(std::move(cells[i * cells.size() / most]));
  return kept;
}

void NumberPlanes(std::vector<LightCell>* cells) {
  std::vector<const LightCell*> first;
  for (LightCell& cell : *cells) {
    const auto found = std::find_if(first.begin(), first.end(), [&](const LightCell* other) {
      return other->surface == cell.surface && Dot(other->normal, cell.normal) > kOnePlane;
    });
    cell.plane = static_cast<int>(found - first.begin());
    if (found == first.end()) first.push_back(&cell);
  }
}

void TraceLight(const PhantomRays& phantoms, const sky::SkyModel& day, const sky::SkyModel& clouds,
                const Mat3& marker_from_world, std::vector<LightCell>* cells) {
  std::vector<FacingPoint> points;
  std::vector<CellPart*> parts;
  for (LightCell& cell : *cells) {
    for (auto* part : {&cell.sunny, &cell.shaded}) {
      if (!*part) continue;
      points.push_back({(*part)->place, cell.normal});
      parts.push_back(&**part);
    }
  }
  const auto traced = [&](const sky::SkyModel& sky, LinearRgb CellLight::*light) {
    const auto values = phantoms.Ambient(points, sky, marker_from_world, kPaths);
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i]->light.*light = values[i];
  };
  traced(ScaledSky(day, {1, 1, 1}, {}), &CellLight::sky);
  traced(ScaledSky(day, {}, {1, 1, 1}), &CellLight::reflected);
  traced(clouds, &CellLight::overcast);
  std::erase_if(*cells, [](const LightCell& cell) {
    const auto dark = [](const std::optional<CellPart>& part) {
      if (!part) return false;
      const auto& [sky, reflected, overcast] = part->light;
      return !(std::min({sky.r, sky.g, sky.b, overcast.r, overcast.g, overcast.b}) > 0.0);
    };
    return dark(cell.sunny) || dark(cell.shaded);
  });
}

}  // namespace

std::vector<std::uint8_t> FindSunlitSamples(const PhantomRays& phantoms,
                                            const SurfaceSamples& samples, Vec3 to_sun) {
  const auto& all = samples.samples();
  std::vector<std::uint8_t> sunlit(all.size());
  ParallelFor(all.size(), 0, [&](std::size_t i) {
    sunlit[i] = all[i].frames > 0 && Dot(all[i].normal, to_sun) > 0.0 &&
                phantoms.IsUnoccluded(all[i].point, to_sun);
  });
  return sunlit;
}

std::optional<CellStep> FindStep(const SurfaceSamples& samples, const Members& part) {
  const auto& all = samples.samples();
  Members sorted = part;
  std::sort(sorted.begin(), sorted.end(), [&](auto a, auto b) {
    return Brightness(all[a].log_rgb) < Brightness(all[b].log_rgb);
  });
  const auto n = static_cast<double>(sorted.size());
  double sum = 0.0, square = 0.0;
  for (const auto i : sorted) {
    const double value = Brightness(all[i].log_rgb);
    sum += value;
    square += value * value;
  }
  // Two-means; every split is tried, since there are few.
  std::size_t split = 0;
  double least = square, below = 0.0, low = 0.0, high = 0.0;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    below += Brightness(all[sorted[i - 1]].log_rgb);
    const auto m = static_cast<double>(i);
    const double rest = square - below * below / m - (sum - below) * (sum - below) / (n - m);
    if (split > 0 && rest >= least) continue;
    split = i;
    least = rest;
    low = below / m;
    high = (sum - below) / (n - m);
  }
  const double share = static_cast<double>(split) / n, apart = high - low;
  const double spread = std::sqrt(std::max(0.0, least / n));
  if (split == 0 || apart < kMinStep || share < kSideShare || share > 1 - kSideShare ||
      spread > kTwoLevels * apart)
    return std::nullopt;
  const std::span<const std::uint32_t> whole(sorted);
  const auto dark = whole.first(split), bright = whole.subspan(split);
  if (spread > kSharp * apart) {
    const auto middle = [&](std::span<const std::uint32_t> members) {
      Vec3 total;
      for (const auto i : members) total = total + all[i].point.xyz;
      return total * (1.0 / static_cast<double>(members.size()));
    };
    const Vec3 centre = middle(sorted);
    double radius = 0.0;
    for (const auto i : sorted)
      radius += Dot(all[i].point.xyz - centre, all[i].point.xyz - centre) / n;
    if (Norm(middle(dark) - middle(bright)) < kApart * std::sqrt(radius)) return std::nullopt;
  }
  const CellPart of_dark = PartOf(samples, dark), of_bright = PartOf(samples, bright);
  CellStep step;
  for (std::size_t c = 0; c < 3; ++c) step.contrast[c] = of_bright.log_rgb[c] - of_dark.log_rgb[c];
  step.bright = Brightness(of_bright.log_rgb);
  return step;
}

std::vector<LightCell> FindLightCells(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                      const sky::SkyModel& day, const sky::SkyModel& clouds,
                                      const Mat3& marker_from_world) {
  const auto& all = samples.samples();
  const Vec3 to_sun = Normalized(marker_from_world * day.ToSun().xyz);
  const TangentFrame sun(to_sun);
  const std::vector<std::uint8_t> sunlit = FindSunlitSamples(phantoms, samples, to_sun);
  struct Sides {
    Members lit, dark;
  };
  std::vector<Sides> by_cell(samples.cells());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (all[i].frames == 0) continue;
    (sunlit[i] != 0 ? by_cell[all[i].cell].lit : by_cell[all[i].cell].dark).push_back(i);
  }
  const auto is_crossed = [&](const Sides& sides) {
    return !sides.lit.empty() && !sides.dark.empty() &&
           Dot(all[sides.lit.front()].normal, to_sun) >= kGrazingCosine;
  };
  ParallelFor(by_cell.size(), 0, [&](std::size_t k) {
    if (!is_crossed(by_cell[k])) return;
    std::erase_if(by_cell[k].lit,
                  [&](auto i) { return !IsClear(phantoms, all[i], sun, /*lit=*/true); });
    std::erase_if(by_cell[k].dark,
                  [&](auto i) { return !IsClear(phantoms, all[i], sun, /*lit=*/false); });
    if (by_cell[k].lit.size() < kMinPerSide || by_cell[k].dark.size() < kMinPerSide)
      by_cell[k] = {};
  });
  std::vector<LightCell> sunny, shaded;
  std::vector<std::pair<std::size_t, LightCell>> crossed;
  for (std::uint32_t k = 0; k < by_cell.size(); ++k) {
    const auto& [lit, dark] = by_cell[k];
    if (lit.size() + dark.size() < kMinSamples) continue;
    const SurfaceSample& first = all[lit.empty() ? dark.front() : lit.front()];
    LightCell cell;
    cell.index = k;
    cell.surface = std::max(first.surface, -1);
    cell.normal = first.normal;
    cell.albedo = first.albedo;
    cell.sun = day.SunNormalIrradiance() * std::max(0.0, Dot(first.normal, to_sun));
    if (!lit.empty()) cell.sunny = PartOf(samples, lit);
    if (!dark.empty()) cell.shaded = PartOf(samples, dark);
    if (!lit.empty() && !dark.empty()) {
      crossed.emplace_back(std::min(lit.size(), dark.size()), std::move(cell));
      continue;
    }
    const double cosine = Dot(first.normal, to_sun);
    if (!lit.empty() && cosine < kGrazingCosine) continue;
    cell.step = FindStep(samples, lit.empty() ? dark : lit);
    (lit.empty() ? shaded : sunny).push_back(std::move(cell));
  }
  std::stable_sort(crossed.begin(), crossed.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  if (crossed.size() > kMaxCrossed) crossed.resize(kMaxCrossed);
  std::vector<LightCell> cells = Thinned(std::move(sunny), kMaxSunny);
  for (LightCell& cell : Thinned(std::move(shaded), kMaxShaded)) cells.push_back(std::move(cell));
  for (auto& [size, cell] : crossed) cells.push_back(std::move(cell));
  TraceLight(phantoms, day, clouds, marker_from_world, &cells);
  NumberPlanes(&cells);
  return cells;
}

}  // namespace pleinair::compositor
