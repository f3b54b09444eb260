#include "compositor/photometry/estimate/sunlight_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "base/quantile.h"
#include "compositor/light/sampling.h"
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
  int cells = 0;
};

/// What shade is around a place: that around the nearest cell across the sun's rays.
class ShadeAround {
 public:
  ShadeAround(const std::vector<LightCell>& cells, const LightPosterior& posterior, Vec3 to_sun)
      : posterior_(posterior), across_(to_sun) {
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (posterior.shade[k].depth > 0.0)
        places_.emplace_back(Across(cells[k].sunny->place.xyz), k);
    }
  }
  const std::array<double, kCellStates>& At(Vec3 place) const {
    const auto [x, y] = Across(place);
    std::size_t nearest = 0;
    double least = 1e300;
    for (const auto& [at, cell] : places_) {
      const double distance = std::hypot(at.first - x, at.second - y);
      if (distance >= least) continue;
      least = distance;
      nearest = cell;
    }
    return posterior_.shade[nearest].states_around;
  }

 private:
  std::pair<double, double> Across(Vec3 place) const {
    return {Dot(place, across_.tangent), Dot(place, across_.bitangent)};
  }

  const LightPosterior& posterior_;
  TangentFrame across_;
  std::vector<std::pair<std::pair<double, double>, std::size_t>> places_;
};

std::map<int, std::vector<PlaneLight>> PlanesOf(const std::vector<LightCell>& cells,
                                                const LightPosterior& posterior) {
  std::map<int, PlaneLight> planes;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (posterior.shade[k].depth <= 0.0) continue;
    PlaneLight& plane = planes[cells[k].plane];
    plane.cell = &cells[k];
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
  const ShadeAround around(cells, posterior, to_sun);
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
    const auto states = LevelEvidence::StatesOf(cell, at, around.At(first.point.xyz), 0.0);
    const double open = states[kOpen] + states[kGap] + states[kStray] + states[kNearlyOpen];
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
