#include "compositor/photometry/estimate/sunlight_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "base/quantile.h"
#include "compositor/photometry/estimate/cell_model.h"
#include "compositor/photometry/estimate/level_evidence.h"
#include "compositor/photometry/estimate/light_cells.h"

namespace pleinair::compositor {
namespace {

// Cosine below which the sun is too faint on a surface to tell shade from pattern.
constexpr double kFaint = 0.2;
// Share of the sun below which a sample has none, and above which it has all. In between, patterns
// and half-light cannot be separated.
constexpr double kNoSun = 0.1, kAllSun = 0.9;

/// What the fit found on the cells of a plane, as means.
struct PlaneLight {
  const LightCell* cell = nullptr;  // Any of them.
  double level = 0.0, depth = 0.0;
  UnmodelledShade around;
  int cells = 0;
};

std::map<int, std::vector<PlaneLight>> PlanesOf(const std::vector<LightCell>& cells,
                                                const LightPosterior& posterior) {
  std::map<int, PlaneLight> planes;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (posterior.shade[k].depth <= 0.0) continue;
    PlaneLight& plane = planes[cells[k].plane];
    plane.cell = &cells[k];
    plane.around = posterior.shade[k].around;
    ++plane.cells;
    plane.level += (posterior.shade[k].level - plane.level) / plane.cells;
    plane.depth += (posterior.shade[k].depth - plane.depth) / plane.cells;
  }
  std::map<int, std::vector<PlaneLight>> by_surface;
  for (const auto& [number, plane] : planes) by_surface[plane.cell->surface].push_back(plane);
  return by_surface;
}

}  // namespace

SunTransmittanceMap MapSunlight(const PhantomRays& phantoms, const SurfaceSamples& samples,
                                const std::vector<LightCell>& cells,
                                const LightPosterior& posterior, Vec3 to_sun) {
  const auto planes = PlanesOf(cells, posterior);
  const auto& all = samples.samples();
  const std::vector<std::uint8_t> sunlit = FindSunlitSamples(phantoms, samples, to_sun);
  std::vector<std::vector<std::uint32_t>> by_cell(samples.cells());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (sunlit[i] != 0 && Dot(all[i].normal, to_sun) >= kFaint) by_cell[all[i].cell].push_back(i);
  }
  std::vector<SunlitSample> mapped;
  for (const auto& members : by_cell) {
    if (members.empty()) continue;
    const SurfaceSample& first = all[members.front()];
    const auto of_surface = planes.find(std::max(first.surface, -1));
    if (of_surface == planes.end()) continue;
    const auto plane = std::find_if(of_surface->second.begin(), of_surface->second.end(),
                                    [&](const PlaneLight& candidate) {
                                      return Dot(candidate.cell->normal, first.normal) > kOnePlane;
                                    });
    if (plane == of_surface->second.end()) continue;
    std::vector<double> values;
    for (const auto i : members) values.push_back(Brightness(all[i].log_rgb));
    LightCell cell = *plane->cell;
    cell.sunny->log_rgb.fill(Median(values));
    cell.shaded.reset();
    cell.step = FindStep(samples, members);
    const CellPrediction at = PredictAtLevel(cell, plane->level, posterior.log_sky);
    const auto states = LevelEvidence::StatesOf(cell, at, plane->around, 0.0);
    const double open = states[kOpen] + states[kStray] + states[kNearlyOpen];
    const double ambient = std::exp(-plane->depth);
    for (std::size_t k = 0; k < members.size(); ++k) {
      const double share = (std::exp(values[k] - plane->level) - ambient) / (1 - ambient);
      const double t = std::clamp((share - kNoSun) / (kAllSun - kNoSun), 0.0, 1.0);
      mapped.push_back({all[members[k]].point.xyz, open + (1 - open) * t * t * (3 - 2 * t),
                        all[members[k]].footprint_m});
    }
  }
  return BuildSunTransmittanceMap(to_sun, mapped);
}

}  // namespace pleinair::compositor
