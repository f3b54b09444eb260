#include "compositor/photometry/shadow_regression.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel_for.h"

namespace pleinair::compositor {
namespace {

constexpr int kMinSurfaceSamples = 12;
constexpr double kGrazing = 0.1;  // Cosine below which a surface receives hardly any sun.
// A larger deviation of the brightness from the cell's median has another cause.
constexpr double kOutlier = 1.5;
// Acceptance: contrast, also in standard errors, and cells with a boundary.
constexpr double kSignificance = 4.0, kMinContrast = 0.08;
constexpr int kMinCells = 4;

}  // namespace

std::vector<BrightnessCell> BrightnessCellsOf(const SurfaceSamples& samples, Vec3 to_sun) {
  std::vector<BrightnessCell> all(samples.cells());
  for (std::uint32_t i = 0; i < samples.samples().size(); ++i) {
    const SurfaceSample& sample = samples.samples()[i];
    if (sample.frames == 0 || Dot(sample.normal, to_sun) < kGrazing) continue;
    all[sample.cell].surface_samples.push_back(i);
  }
  std::vector<BrightnessCell> cells;
  for (BrightnessCell& cell : all) {
    if (cell.surface_samples.size() < kMinSurfaceSamples) continue;
    std::vector<double> values;
    values.reserve(cell.surface_samples.size());
    for (const std::uint32_t surface_sample : cell.surface_samples) {
      const auto& log_rgb = samples.samples()[surface_sample].log_rgb;
      values.push_back((log_rgb[0] + log_rgb[1] + log_rgb[2]) / 3);
    }
    std::vector<double> sorted = values;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    cell.brightness.reserve(values.size());
    for (const double value : values) {
      cell.brightness.push_back(std::clamp(value - *middle, -kOutlier, kOutlier));
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

double VarianceOf(const BrightnessCell& cell) {
  double sum = 0.0, squares = 0.0;
  for (const double value : cell.brightness) {
    sum += value;
    squares += value * value;
  }
  return squares - sum * sum / static_cast<double>(cell.brightness.size());
}

void ShadowFit::Add(const ShadowFit& other) {
  covariance += other.covariance;
  variance += other.variance;
  cells += other.cells;
}

ShadowFit ShadowFit::Without(const ShadowFit& other) const {
  return {covariance - other.covariance, variance - other.variance, cells - other.cells};
}

ShadowFit GroupedShadowFit::Total() const {
  ShadowFit total;
  for (const ShadowFit& fit : groups) total.Add(fit);
  return total;
}

ShadowFit GroupedShadowFit::Without(int group) const {
  return group == kAll ? Total() : Total().Without(groups[group]);
}

double JackknifeError(const std::array<double, GroupedShadowFit::kGroups>& without) {
  double sum = 0.0, spread = 0.0;
  for (const double value : without) sum += value;
  for (const double value : without) spread += std::pow(value - sum / without.size(), 2);
  return std::sqrt(spread * (without.size() - 1.0) / without.size());
}

std::vector<GroupedShadowFit> ShadowRegression::FitAll(const std::vector<BrightnessCell>& cells,
                                                       std::span<const Vec3> suns) const {
  std::vector<std::vector<ShadowFit>> of_cells(cells.size());
  ParallelFor(cells.size(), 0, [&](std::size_t c) {
    of_cells[c].reserve(suns.size());
    for (const Vec3 sun : suns) of_cells[c].push_back(FitCell(cells[c], sun));
  });
  std::vector<GroupedShadowFit> fits(suns.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t s = 0; s < suns.size(); ++s) {
      fits[s].groups[c % GroupedShadowFit::kGroups].Add(of_cells[c][s]);
    }
  }
  return fits;
}

std::vector<BrightnessCell> ShadowRegression::Crossed(std::vector<BrightnessCell> cells,
                                                      std::span<const Vec3> suns) const {
  std::vector<std::uint8_t> crossed(cells.size());
  ParallelFor(cells.size(), 0, [&](std::size_t c) {
    for (const Vec3 sun : suns) {
      if (crossed[c] != 0) break;
      crossed[c] = FitCell(cells[c], sun).variance > 0.0;
    }
  });
  std::vector<BrightnessCell> kept;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (crossed[c] != 0) kept.push_back(std::move(cells[c]));
  }
  return kept;
}

ShadowFit ShadowRegression::FitCell(const BrightnessCell& cell, Vec3 sun) const {
  double lit = 0.0, bright = 0.0, product = 0.0;
  for (std::size_t i = 0; i < cell.surface_samples.size(); ++i) {
    bright += cell.brightness[i];
    if (!phantoms_.IsUnoccluded(samples_.samples()[cell.surface_samples[i]].point, sun)) continue;
    lit += 1.0;
    product += cell.brightness[i];
  }
  const auto count = static_cast<double>(cell.surface_samples.size());
  ShadowFit fit;
  fit.variance = lit - lit * lit / count;
  fit.covariance = product - bright * lit / count;
  fit.cells = fit.variance > 1.5 ? 1 : 0;  // At least two surface samples on either side.
  return fit;
}

BestStep BestOf(const std::vector<GroupedShadowFit>& fits, const std::vector<double>& steps,
                int left_out) {
  std::vector<double> explained;
  explained.reserve(fits.size());
  for (const GroupedShadowFit& fit : fits) explained.push_back(fit.Without(left_out).Explained());
  const auto best = static_cast<std::size_t>(std::max_element(explained.begin(), explained.end()) -
                                             explained.begin());
  if (best == 0 || best + 1 == explained.size()) return {best, steps[best]};
  const double left = explained[best - 1], right = explained[best + 1];
  const double bend = left - 2 * explained[best] + right;
  const double shift = bend < 0.0 ? 0.5 * (left - right) / bend : 0.0;
  return {best, steps[best] + std::clamp(shift, -0.5, 0.5) * (steps[1] - steps[0])};
}

std::optional<SignificantStep> SignificantOf(const std::vector<GroupedShadowFit>& fits,
                                             const std::vector<double>& steps) {
  const BestStep best = BestOf(fits, steps, GroupedShadowFit::kAll);
  const GroupedShadowFit& there = fits[best.index];
  std::array<double, GroupedShadowFit::kGroups> values{}, contrasts{};
  for (int g = 0; g < GroupedShadowFit::kGroups; ++g) {
    values[g] = BestOf(fits, steps, g).value;
    contrasts[g] = there.Without(g).Contrast();
  }
  const ShadowFit whole = there.Total();
  if (whole.cells < kMinCells || whole.Contrast() < kMinContrast ||
      whole.Contrast() < kSignificance * JackknifeError(contrasts)) {
    return std::nullopt;
  }
  // Rounding to steps adds a uniform error.
  const double error = std::hypot(JackknifeError(values), (steps[1] - steps[0]) / std::sqrt(12.0));
  return SignificantStep{best.value, error, whole};
}

std::vector<double> EvenSteps(double from, double to, double step) {
  std::vector<double> values;
  const int count = static_cast<int>(std::lround((to - from) / step));
  values.reserve(count + 1);
  for (int i = 0; i <= count; ++i) values.push_back(from + i * step);
  return values;
}

}  // namespace pleinair::compositor
