#include "compositor/photometry/estimate/shaded_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pleinair::compositor {
namespace {

constexpr double kLevelCosine = 0.9;  // Between up and a plane that faces the whole sky.
constexpr int kTurns = 4;

/// The marker's brightness is the prior of the exposure scale; only its edges count here.
bool IsMarker(int surface) { return surface < 0; }

}  // namespace

ShadedLevels::ShadedLevels(const std::vector<LightCell>& cells, const ShadeField* field, Vec3 up,
                           std::span<const UnmodelledShade> mixes,
                           std::span<const SkyError> sky_errors, double plane_error,
                           const Predict& predict)
    : field_(field), mixes_(mixes), plane_error_(plane_error), level_errors_(cells.size()) {
  prior_.assign((cells.size() + 1) * mixes.size(), 1.0 / static_cast<double>(mixes.size()));
  std::map<std::pair<int, int>, std::size_t> numbers;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    auto& planes = surfaces_[cells[i].surface];
    const auto [number, is_new] =
        numbers.emplace(std::pair(cells[i].surface, cells[i].plane), planes.size());
    if (is_new) {
      planes.emplace_back();
      if (Dot(cells[i].normal, up) > kLevelCosine) {
        planes.back().sky_errors = {SkyError{}};
      } else {
        planes.back().sky_errors.assign(sky_errors.begin(), sky_errors.end());
      }
      planes.back().tables.resize(planes.back().sky_errors.size());
    }
    Plane& plane = planes[number->second];
    plane.cells.push_back(i);
    for (std::size_t j = 0; j < plane.sky_errors.size(); ++j) {
      std::vector<LevelDensity>& tables = plane.tables[j];
      tables.resize(tables.size() + mixes.size());
      LevelEvidence::OfCell(cells[i], predict(cells[i], plane.sky_errors[j].log), mixes,
                            std::span(tables).last(mixes.size()));
    }
  }
}

ShadedLevels::Densities ShadedLevels::DensitiesOf(const Plane& plane) const {
  // The product of so many densities does not leave the range of numbers; logarithms are slow.
  constexpr std::size_t kAtOnce = 8;
  constexpr float kLeast = 1e-36F;
  Densities found;
  const std::size_t skies = plane.sky_errors.size(), mixes = mixes_.size();
  found.cells.assign(skies, std::vector<LevelDensity>(plane.cells.size()));
  std::vector<LevelFunction> logs(skies);
  for (std::size_t j = 0; j < skies; ++j) {
    logs[j].fill(std::log(plane.sky_errors[j].probability));
    LevelFunction product;
    product.fill(1.0);
    for (std::size_t k = 0; k < plane.cells.size(); ++k) {
      LevelDensity density{};
      for (std::size_t m = 0; m < mixes; ++m) {
        const auto weight = static_cast<float>(prior_[plane.cells[k] * mixes + m]);
        const LevelDensity& table = plane.tables[j][k * mixes + m];
        for (int u = 0; u < LevelGrid::kCount; ++u) density[u] += weight * table[u];
      }
      for (int u = 0; u < LevelGrid::kCount; ++u) {
        density[u] = std::max(density[u], kLeast);
        product[u] *= static_cast<double>(density[u]);
      }
      found.cells[j][k] = density;
      if ((k + 1) % kAtOnce != 0 && k + 1 < plane.cells.size()) continue;
      for (int u = 0; u < LevelGrid::kCount; ++u) {
        logs[j][u] += std::log(product[u]);
        product[u] = 1.0;
      }
    }
  }
  found.sky_error_given_level.resize(skies);
  for (int u = 0; u < LevelGrid::kCount; ++u) {
    double top = logs[0][u];
    for (const LevelFunction& log : logs) top = std::max(top, log[u]);
    double sum = 0.0;
    for (const LevelFunction& log : logs) sum += std::exp(log[u] - top);
    found.log[u] = top + std::log(sum);
    for (std::size_t j = 0; j < skies; ++j)
      found.sky_error_given_level[j][u] = std::exp(logs[j][u] - found.log[u]);
  }
  return found;
}

SurfaceEvidence ShadedLevels::EvidenceOf(const std::vector<Plane>& planes,
                                         SurfaceDensities* densities) const {
  std::vector<LevelFunction> logs;
  for (const Plane& plane : planes) {
    densities->push_back(DensitiesOf(plane));
    logs.push_back(densities->back().log);
  }
  return {std::move(logs), plane_error_};
}

void ShadedLevels::ExplainCells(const Plane& plane, const Densities& densities,
                                const LevelFunction& levels, std::vector<double>* posterior) const {
  // Sums of neighbours in turn, so that they are added side by side.
  constexpr int kLanes = 4, kWhole = LevelGrid::kCount / kLanes * kLanes;
  for (std::size_t j = 0; j < plane.sky_errors.size(); ++j) {
    for (std::size_t k = 0; k < plane.cells.size(); ++k) {
      LevelDensity given;
      for (int u = 0; u < LevelGrid::kCount; ++u) {
        given[u] = static_cast<float>(levels[u] * densities.sky_error_given_level[j][u]) /
                   densities.cells[j][k][u];
      }
      const std::size_t row = plane.cells[k] * mixes_.size();
      for (std::size_t m = 0; m < mixes_.size(); ++m) {
        const LevelDensity& table = plane.tables[j][k * mixes_.size() + m];
        std::array<float, kLanes> sums{};
        for (int u = 0; u < kWhole; u += kLanes) {
          for (int lane = 0; lane < kLanes; ++lane) sums[lane] += given[u + lane] * table[u + lane];
        }
        for (int u = kWhole; u < LevelGrid::kCount; ++u) sums[0] += given[u] * table[u];
        (*posterior)[row + m] +=
            prior_[row + m] * static_cast<double>((sums[0] + sums[1]) + (sums[2] + sums[3]));
      }
    }
  }
}

LevelFunction ShadedLevels::Uncoupled() const {
  LevelFunction logs{};
  for (const auto& [number, planes] : surfaces_) {
    SurfaceDensities densities;
    const SurfaceEvidence surface = EvidenceOf(planes, &densities);
    for (int i = 0; i < LevelGrid::kCount; ++i)
      logs[i] += IsMarker(number) ? LogSum(densities.front().log) : surface.At(LevelGrid::At(i));
  }
  return logs;
}

double ShadedLevels::Step(double e) {
  std::vector<double> posterior(level_errors_.size() * mixes_.size());
  double log = 0.0;
  for (const auto& [number, planes] : surfaces_) {
    SurfaceDensities densities;
    const SurfaceEvidence surface = EvidenceOf(planes, &densities);
    log += IsMarker(number) ? LogSum(densities.front().log) : surface.At(e);
    for (std::size_t p = 0; p < planes.size(); ++p) {
      const LevelFunction levels =
          IsMarker(number) ? Normalized(densities[p].log) : surface.LevelsOf(p, e);
      const auto best = std::max_element(levels.begin(), levels.end()) - levels.begin();
      for (const std::size_t cell : planes[p].cells)
        level_errors_[cell] = LevelGrid::At(static_cast<int>(best));
      if (mixes_.size() > 1) ExplainCells(planes[p], densities[p], levels, &posterior);
    }
  }
  if (mixes_.size() > 1) prior_ = field_->Prior(posterior, mixes_.size());
  return log;
}

double ShadedLevels::At(double e) {
  double log = 0.0;
  for (int turn = 0; turn < (mixes_.size() > 1 ? kTurns : 1); ++turn) log = Step(e);
  return log;
}

std::array<double, kCellStates> ShadedLevels::StatePriorOf(std::size_t cell,
                                                           const CellPrediction& prediction) const {
  std::array<double, kCellStates> prior{};
  for (std::size_t m = 0; m < mixes_.size(); ++m) {
    const auto of_mix = StatePrior(prediction, mixes_[m]);
    for (std::size_t s = 0; s < kCellStates; ++s)
      prior[s] += prior_[cell * mixes_.size() + m] * of_mix[s];
  }
  return prior;
}

double ShadedLevels::ShareOnMarker() const {
  double share = 0.0;
  for (std::size_t m = 0; m < mixes_.size(); ++m)
    share += prior_[level_errors_.size() * mixes_.size() + m] * mixes_[m].share;
  return share;
}

}  // namespace pleinair::compositor
