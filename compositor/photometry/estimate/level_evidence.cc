#include "compositor/photometry/estimate/level_evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "compositor/photometry/student_distribution.h"

namespace pleinair::compositor {
namespace {

// One standard deviation of the pattern of a material, logarithmic; some cells hold more of it.
constexpr double kPattern = 0.12, kStrongPattern = 0.25, kStrongShare = 0.25;
// Scale of the error of described albedos, and freedom of Student's distribution.
constexpr double kAlbedoError = 0.25, kAlbedoFreedom = 3.0;

/// Density of a cell's brightness about its level, and the integral of that, as tables.
class PatternTables {
 public:
  PatternTables() {
    const auto normal = [](double x, double s) {
      return std::exp(-0.5 * x * x / s / s) / (s * std::sqrt(2 * std::numbers::pi));
    };
    const auto share = [](double x, double s) {
      return 0.5 * std::erfc(-x / s / std::numbers::sqrt2);
    };
    for (int i = 0; i < kCount; ++i) {
      const double x = (i - kCount / 2) * kStep;
      density_[i] =
          (1 - kStrongShare) * normal(x, kPattern) + kStrongShare * normal(x, kStrongPattern);
      share_[i] = (1 - kStrongShare) * share(x, kPattern) + kStrongShare * share(x, kStrongPattern);
    }
  }
  double Density(double x) const { return density_[Index(x)]; }
  double Share(double x) const { return share_[Index(x)]; }

 private:
  static constexpr int kCount = 2001;
  static constexpr double kStep = 0.002;
  static int Index(double x) {
    return static_cast<int>(std::clamp(x / kStep + kCount / 2 + 0.5, 0.0, kCount - 1.0));
  }
  std::array<double, kCount> density_{}, share_{};
};

const PatternTables& Tables() {
  static const PatternTables tables;
  return tables;
}

/// Densities of all states at the error u.
std::array<double, kCellStates> Levels(const LightCell& cell, const CellPrediction& at, double u) {
  const PatternTables& table = Tables();
  const double off = LevelOf(cell) - u;
  const double beyond_open = table.Share(off - at.open);
  /// Mean density of the levels from `low` to the open one, `beyond` as `beyond_open` of `low`.
  const auto up_from = [&](double low, double beyond) {
    return at.open - low < LevelGrid::kStep ? table.Density(off - at.open)
                                            : (beyond - beyond_open) / (at.open - low);
  };
  std::array<double, kCellStates> levels{};
  levels[kOpen] = table.Density(off - at.open);
  levels[kDark] = table.Density(off - at.dark);
  levels[kPartial] = up_from(at.dark, table.Share(off - at.dark));
  double beyond = table.Share(off - at.crown[0]);
  levels[kFiltered] = up_from(at.crown[0], beyond);
  for (std::size_t i = 0; i + 1 < kBands.size(); ++i) {
    const double next = table.Share(off - at.crown[i + 1]);
    const double width = at.crown[i + 1] - at.crown[i];
    levels[kBand + i] = width > 0.01 ? (beyond - next) / width : levels[kOpen];
    beyond = next;
  }
  levels[kNearlyOpen] = up_from(at.crown.back(), beyond);
  // Where a step shows in the cell, its bright level is in the open.
  levels[kDivided] = cell.step ? table.Density(cell.step->bright - u - at.open) : levels[kPartial];
  levels[kMottled] = levels[kPartial];
  levels[kStray] = 1.0 / (LevelGrid::kCount * LevelGrid::kStep);
  return levels;
}

double LogNormal(double value, double sigma) {
  const double z = value / sigma;
  return -0.5 * z * z - std::log(sigma * std::sqrt(2 * std::numbers::pi));
}

/// Likelihood of the surface's albedo error plus e, by one plane.
LevelFunction Blurred(const LevelFunction& log_values, double sigma) {
  const double top = *std::max_element(log_values.begin(), log_values.end());
  LevelFunction blurred{};
  const int reach = static_cast<int>(std::ceil(3.0 * sigma / LevelGrid::kStep));
  std::vector<double> kernel(reach + 1);
  for (int k = 0; k <= reach; ++k)
    kernel[k] = std::exp(LogNormal(k * LevelGrid::kStep, sigma)) * LevelGrid::kStep;
  LevelFunction values;
  for (int i = 0; i < LevelGrid::kCount; ++i) values[i] = std::exp(log_values[i] - top);
  for (int i = 0; i < LevelGrid::kCount; ++i) {
    double sum = 0.0;
    for (int k = std::max(-reach, -i); k <= std::min(reach, LevelGrid::kCount - 1 - i); ++k)
      sum += kernel[std::abs(k)] * values[i + k];
    blurred[i] = top + std::log(std::max(sum, 1e-300));
  }
  return blurred;
}

/// Sum over the planes' blurred evidence but one (none: past the end).
LevelFunction SumOfPlanes(std::span<const LevelFunction> planes, double sigma,
                          std::size_t without) {
  LevelFunction sum{};
  for (std::size_t p = 0; p < planes.size(); ++p) {
    if (p == without) continue;
    const LevelFunction blurred = Blurred(planes[p], sigma);
    for (int i = 0; i < LevelGrid::kCount; ++i) sum[i] += blurred[i];
  }
  return sum;
}

double LogAlbedoPrior(double error) {
  // Normalising constant of Student's distribution with three degrees of freedom: 2 / (π √3 scale).
  static const double log_constant =
      std::log(2.0 / (std::numbers::pi * std::sqrt(3.0) * kAlbedoError));
  return log_constant - StudentCost(error, kAlbedoError, kAlbedoFreedom);
}

}  // namespace

double LevelOf(const LightCell& cell) {
  return Brightness(cell.sunny ? cell.sunny->log_rgb : cell.shaded->log_rgb);
}

double LogSum(const LevelFunction& values) {
  const double top = *std::max_element(values.begin(), values.end());
  double sum = 0.0;
  for (const double value : values) sum += std::exp(value - top);
  return top + std::log(sum * LevelGrid::kStep);
}

std::vector<LevelFunction> LevelEvidence::OfPlane(std::span<const LightCell* const> cells,
                                                  std::span<const CellPrediction> predictions,
                                                  std::span<const UnmodelledShade> shades) {
  std::vector<LevelFunction> evidence(shades.size()), product(shades.size());
  for (LevelFunction& values : product) values.fill(1.0);
  // A mix has few of the many states: those with a prior above 0.
  std::vector<std::vector<std::pair<std::size_t, double>>> weights(shades.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    for (std::size_t m = 0; m < shades.size(); ++m) {
      const auto prior = StatePrior(predictions[k], shades[m]);
      weights[m].clear();
      for (std::size_t s = 0; s < kCellStates; ++s) {
        if (prior[s] > 0.0) weights[m].emplace_back(s, prior[s] * predictions[k].density[s]);
      }
    }
    for (int i = 0; i < LevelGrid::kCount; ++i) {
      const auto levels = Levels(*cells[k], predictions[k], LevelGrid::At(i));
      for (std::size_t m = 0; m < shades.size(); ++m) {
        double sum = 0.0;
        for (const auto& [state, weight] : weights[m]) sum += weight * levels[state];
        product[m][i] *= sum;
      }
    }
    // Logarithms are slow; products of a few densities do not leave the range of numbers.
    constexpr std::size_t kAtOnce = 8;
    if ((k + 1) % kAtOnce != 0 && k + 1 < cells.size()) continue;
    for (std::size_t m = 0; m < shades.size(); ++m) {
      for (int i = 0; i < LevelGrid::kCount; ++i) {
        evidence[m][i] += std::log(std::max(product[m][i], 1e-300));
        product[m][i] = 1.0;
      }
    }
  }
  return evidence;
}

LevelFunction LevelEvidence::OfSurface(std::span<const LevelFunction> planes, double plane_error) {
  const LevelFunction sum = SumOfPlanes(planes, plane_error, planes.size());
  const double top = *std::max_element(sum.begin(), sum.end());
  LevelFunction values, of_exposure{};
  for (int i = 0; i < LevelGrid::kCount; ++i) values[i] = std::exp(sum[i] - top);
  static const auto prior = [] {
    std::array<double, 2 * LevelGrid::kCount> densities;
    for (int d = 0; d < 2 * LevelGrid::kCount; ++d)
      densities[d] = std::exp(LogAlbedoPrior((d - LevelGrid::kCount) * LevelGrid::kStep));
    return densities;
  }();
  for (int e = 0; e < LevelGrid::kCount; ++e) {
    double total = 0.0;
    for (int i = 0; i < LevelGrid::kCount; ++i)
      total += prior[i - e + LevelGrid::kCount] * values[i];
    of_exposure[e] = top + std::log(std::max(total * LevelGrid::kStep, 1e-300));
  }
  return of_exposure;
}

std::array<double, kCellStates> LevelEvidence::StatesOf(const LightCell& cell,
                                                        const CellPrediction& prediction,
                                                        UnmodelledShade shade, double u) {
  std::array<double, kCellStates> states = Levels(cell, prediction, u);
  const auto prior = StatePrior(prediction, shade);
  double sum = 0.0;
  for (std::size_t s = 0; s < kCellStates; ++s) {
    states[s] *= prior[s] * prediction.density[s];
    sum += states[s];
  }
  for (double& state : states) state = sum > 0.0 ? state / sum : 0.0;
  return states;
}

double LevelEvidence::BestLevel(std::span<const LevelFunction> planes, std::size_t plane, double e,
                                double plane_error) {
  const LevelFunction others = SumOfPlanes(planes, plane_error, plane);
  LevelFunction albedo;
  for (int i = 0; i < LevelGrid::kCount; ++i)
    albedo[i] = others[i] + LogAlbedoPrior(LevelGrid::At(i) - e);
  const LevelFunction prior = Blurred(albedo, plane_error);
  double best = 0.0, most = -1e300;
  for (int i = 0; i < LevelGrid::kCount; ++i) {
    if (prior[i] + planes[plane][i] <= most) continue;
    most = prior[i] + planes[plane][i];
    best = LevelGrid::At(i);
  }
  return best;
}

}  // namespace pleinair::compositor
