#include "compositor/photometry/estimate/light_cells.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "base/parallel_for.h"
#include "compositor/light/sampling.h"
#include "compositor/light/scaled_sky.h"
#include "compositor/photometry/sample_medians.h"
#include "compositor/photometry/shade/shadow_cell.h"
#include "compositor/photometry/shadow_side.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kMaxCrossed = 120, kMaxSunny = 160, kMaxShaded = 48;
constexpr std::uint32_t kPaths = 192;
constexpr std::size_t kMinSamples = 12;  // In a cell.
constexpr std::size_t kMinPerSide = 5;   // On each side of a shadow boundary.
// Logarithmic. Noise and mottling make smaller steps everywhere.
constexpr double kMinStep = 0.25;

using Members = std::vector<std::uint32_t>;

CellPart PartOf(const SurfaceSamples& samples, const Members& members) {
  CellPart part;
  for (int c = 0; c < 3; ++c) part.log_rgb[c] = MedianBrightness(samples, members, c).first;
  part.variance = MedianBrightness(samples, members, -1).second;
  part.place = MiddleOf(samples, members);
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
  Members members = part;
  std::sort(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
    return Brightness(all[a].log_rgb) < Brightness(all[b].log_rgb);
  });
  std::vector<ShadowSample> sorted;
  sorted.reserve(members.size());
  for (const std::uint32_t i : members)
    sorted.push_back({Brightness(all[i].log_rgb), {}, all[i].point.xyz});
  const TwoLevels levels = SplitInTwo(sorted);
  if (levels.high - levels.low < kMinStep || !AreTwoSides(sorted, levels)) return std::nullopt;
  const auto bright = std::span(members).subspan(levels.low_count);
  CellStep step;
  for (int c = 0; c < 3; ++c) {
    step.contrast[c] =
        MedianBrightness(samples, bright, c).first -
        MedianBrightness(samples, std::span(members).first(levels.low_count), c).first;
  }
  step.bright = MedianBrightness(samples, bright, -1).first;
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
    const auto mixes = [&](std::uint32_t i) {
      return ShadowSideOf(phantoms, all[i], sun) == ShadowSide::kNeither;
    };
    std::erase_if(by_cell[k].lit, mixes);
    std::erase_if(by_cell[k].dark, mixes);
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
