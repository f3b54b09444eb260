#include "compositor/photometry/estimate/level_evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "compositor/photometry/student_distribution.h"

namespace pleinair::compositor {
namespace {

/// Pattern of a material, logarithmic: most cells of it are alike, few differ much.
struct Pattern {
  double sigma, share;  ///< One standard deviation, and the share of the cells.
};
constexpr std::array<Pattern, 3> kPatterns{{{0.06, 0.5}, {0.12, 0.3}, {0.25, 0.2}}};
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
      for (const Pattern& pattern : kPatterns) {
        density_[i] += pattern.share * normal(x, pattern.sigma);
        share_[i] += pattern.share * share(x, pattern.sigma);
      }
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
  levels[kGap] = table.Density(off - at.gap);
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

void LevelEvidence::OfCell(const LightCell& cell, const CellPrediction& prediction,
                           std::span<const UnmodelledShade> shades,
                           std::span<LevelDensity> by_mix) {
  std::array<LevelDensity, kCellStates> levels;
  for (int i = 0; i < LevelGrid::kCount; ++i) {
    const auto at = Levels(cell, prediction, LevelGrid::At(i));
    for (std::size_t s = 0; s < kCellStates; ++s) levels[s][i] = static_cast<float>(at[s]);
  }
  for (std::size_t m = 0; m < shades.size(); ++m) {
    const auto prior = StatePrior(prediction, shades[m]);
    by_mix[m] = {};
    for (std::size_t s = 0; s < kCellStates; ++s) {
      // A mix has few of the many states.
      if (prior[s] == 0.0) continue;
      const auto weight = static_cast<float>(prior[s] * prediction.density[s]);
      for (int i = 0; i < LevelGrid::kCount; ++i) by_mix[m][i] += weight * levels[s][i];
    }
  }
}

LevelFunction Normalized(LevelFunction log_values) {
  const double all = LogSum(log_values) - std::log(LevelGrid::kStep);
  for (double& value : log_values) value = std::exp(value - all);
  return log_values;
}

SurfaceEvidence::SurfaceEvidence(std::vector<LevelFunction> planes, double plane_error)
    : planes_(std::move(planes)), plane_error_(plane_error) {
  blurred_.reserve(planes_.size());
  for (const LevelFunction& plane : planes_) {
    blurred_.push_back(Blurred(plane, plane_error));
    for (int i = 0; i < LevelGrid::kCount; ++i) sum_[i] += blurred_.back()[i];
  }
}

double SurfaceEvidence::At(double e) const {
  LevelFunction with_prior;
  for (int i = 0; i < LevelGrid::kCount; ++i)
    with_prior[i] = sum_[i] + LogAlbedoPrior(LevelGrid::At(i) - e);
  return LogSum(with_prior);
}

LevelFunction SurfaceEvidence::LevelsOf(std::size_t plane, double e) const {
  LevelFunction others;
  for (int i = 0; i < LevelGrid::kCount; ++i)
    others[i] = sum_[i] - blurred_[plane][i] + LogAlbedoPrior(LevelGrid::At(i) - e);
  LevelFunction levels = Blurred(others, plane_error_);
  for (int i = 0; i < LevelGrid::kCount; ++i) levels[i] += planes_[plane][i];
  return Normalized(levels);
}

std::array<double, kCellStates> LevelEvidence::StatesOf(
    const LightCell& cell, const CellPrediction& prediction,
    const std::array<double, kCellStates>& prior, double u) {
  std::array<double, kCellStates> states = Levels(cell, prediction, u);
  double sum = 0.0;
  for (std::size_t s = 0; s < kCellStates; ++s) {
    states[s] *= prior[s] * prediction.density[s];
    sum += states[s];
  }
  for (double& state : states) state = sum > 0.0 ? state / sum : 0.0;
  return states;
}

}  // namespace pleinair::compositor
