#include "compositor/photometry/heading_from_shadows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/parallel_for.h"

namespace pleinair::compositor {
namespace {

constexpr double kCoarseStepDeg = 0.75, kFineStepDeg = 0.125, kFineReach_deg = 1.5;
constexpr int kGroups = 8;  // Jackknife groups.
constexpr int kMinSurfaceSamples = 12;
constexpr double kGrazing = 0.1;  // Cosine below which a surface receives hardly any sun.
// A larger deviation of the brightness from the cell's median has another cause.
constexpr double kOutlier = 1.5;
// Acceptance of a heading: contrast in standard errors, and maximum standard error of the heading.
constexpr double kSignificance = 4.0;
constexpr double kMaxUncertainty_deg = 1.0;
constexpr double kMinContrast = 0.08;
// Error of the marker's attitude beside the phantoms, which all edges share: 0.9 mrad, about that
// of a pose in a small image. Below a high sun it turns shadows far.
constexpr double kTilt_deg = 0.05;
constexpr int kMinCells = 4;

/// Surface samples of one cell, as indices into the samples, with their brightness relative to the
/// cell's median.
struct Cell {
  std::vector<std::uint32_t> surface_samples;
  std::vector<double> brightness;
};

/// Regression of brightness on sun visibility: sums of covariance and variance over the cells.
struct Fit {
  double covariance = 0.0, variance = 0.0;
  int cells = 0;
  void Add(const Fit& other) {
    covariance += other.covariance;
    variance += other.variance;
    cells += other.cells;
  }
  Fit Without(const Fit& other) const {
    return {covariance - other.covariance, variance - other.variance, cells - other.cells};
  }
  double Contrast() const { return variance > 0.0 ? covariance / variance : 0.0; }
  double Explained() const { return covariance > 0.0 ? covariance * Contrast() : 0.0; }
};

std::vector<Cell> CellsOf(const SurfaceSamples& samples, Vec3 to_sun) {
  std::vector<Cell> all(samples.cells());
  for (std::uint32_t i = 0; i < samples.samples().size(); ++i) {
    const SurfaceSample& sample = samples.samples()[i];
    if (sample.frames == 0 || Dot(sample.normal, to_sun) < kGrazing) continue;
    all[sample.cell].surface_samples.push_back(i);
  }
  std::vector<Cell> cells;
  for (Cell& cell : all) {
    if (cell.surface_samples.size() < kMinSurfaceSamples) continue;
    std::vector<double> values;
    for (const std::uint32_t surface_sample : cell.surface_samples) {
      const auto& log_rgb = samples.samples()[surface_sample].log_rgb;
      values.push_back((log_rgb[0] + log_rgb[1] + log_rgb[2]) / 3);
    }
    std::vector<double> sorted = values;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    for (const double value : values) {
      cell.brightness.push_back(std::clamp(value - *middle, -kOutlier, kOutlier));
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

class Search {
 public:
  Search(const PhantomRays& phantoms, const SurfaceSamples& samples, Vec3 up, Vec3 to_sun)
      : phantoms_(phantoms), samples_(samples), up_(up), to_sun_(to_sun) {}

  /// Per heading and group of cells.
  using Fits = std::vector<std::array<Fit, kGroups>>;

  Fits FitAll(const std::vector<Cell>& cells, const std::vector<double>& headings_deg) const {
    std::vector<Vec3> suns;
    suns.reserve(headings_deg.size());
    for (const double heading : headings_deg) {
      suns.push_back(Turned(to_sun_, up_, FromDegrees(heading)));
    }
    std::vector<std::vector<Fit>> of_cells(cells.size());
    ParallelFor(cells.size(), 0, [&](std::size_t c) {
      for (const Vec3 sun : suns) of_cells[c].push_back(FitCell(cells[c], sun));
    });
    Fits fits(suns.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
      for (std::size_t h = 0; h < suns.size(); ++h) fits[h][c % kGroups].Add(of_cells[c][h]);
    }
    return fits;
  }

  /// Cells that contain a shadow boundary at some heading.
  std::vector<Cell> Crossed(std::vector<Cell> cells,
                            const std::vector<double>& headings_deg) const {
    std::vector<std::uint8_t> crossed(cells.size());
    ParallelFor(cells.size(), 0, [&](std::size_t c) {
      for (const double heading : headings_deg) {
        if (crossed[c] != 0) break;
        crossed[c] = FitCell(cells[c], Turned(to_sun_, up_, FromDegrees(heading))).variance > 0.0;
      }
    });
    std::vector<Cell> kept;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      if (crossed[c] != 0) kept.push_back(std::move(cells[c]));
    }
    return kept;
  }

 private:
  Fit FitCell(const Cell& cell, Vec3 sun) const {
    double lit = 0.0, bright = 0.0, product = 0.0;
    for (std::size_t i = 0; i < cell.surface_samples.size(); ++i) {
      bright += cell.brightness[i];
      if (!phantoms_.IsUnoccluded(samples_.samples()[cell.surface_samples[i]].point, sun)) continue;
      lit += 1.0;
      product += cell.brightness[i];
    }
    const auto count = static_cast<double>(cell.surface_samples.size());
    Fit fit;
    fit.variance = lit - lit * lit / count;
    fit.covariance = product - bright * lit / count;
    fit.cells = fit.variance > 1.5 ? 1 : 0;  // At least two surface samples on either side.
    return fit;
  }

  const PhantomRays& phantoms_;
  const SurfaceSamples& samples_;
  Vec3 up_, to_sun_;
};

std::vector<double> Steps(double from, double to, double step) {
  std::vector<double> values;
  const int count = static_cast<int>(std::lround((to - from) / step));
  for (int i = 0; i <= count; ++i) values.push_back(from + i * step);
  return values;
}

Fit Total(const std::array<Fit, kGroups>& fits) {
  Fit total;
  for (const Fit& fit : fits) total.Add(fit);
  return total;
}

/// Heading that explains the brightness best, without one group (−1: all groups). A parabola
/// through the best heading and its neighbours refines it.
double Best(const Search::Fits& fits, const std::vector<double>& headings, int left_out,
            std::size_t* index) {
  std::vector<double> explained;
  for (const auto& groups : fits) {
    const Fit total = Total(groups);
    explained.push_back(left_out < 0 ? total.Explained()
                                     : total.Without(groups[left_out]).Explained());
  }
  const auto best = static_cast<std::size_t>(std::max_element(explained.begin(), explained.end()) -
                                             explained.begin());
  if (index != nullptr) *index = best;
  if (best == 0 || best + 1 == explained.size()) return headings[best];
  const double left = explained[best - 1], right = explained[best + 1];
  const double bend = left - 2 * explained[best] + right;
  const double shift = bend < 0.0 ? 0.5 * (left - right) / bend : 0.0;
  return headings[best] + std::clamp(shift, -0.5, 0.5) * (headings[1] - headings[0]);
}

}  // namespace

Vec3 Turned(Vec3 direction, Vec3 unit_axis, Radians angle) {
  // Rodrigues' formula.
  const double c = std::cos(angle.value()), s = std::sin(angle.value());
  return direction * c + Cross(unit_axis, direction) * s +
         unit_axis * (Dot(unit_axis, direction) * (1 - c));
}

std::optional<HeadingEstimate> EstimateHeading(const PhantomRays& phantoms,
                                               const SurfaceSamples& samples, Vec3 up,
                                               Vec3 to_sun) {
  if (Dot(up, to_sun) <= 0.0) return std::nullopt;
  const Search search(phantoms, samples, up, to_sun);
  const std::vector<double> coarse = Steps(-kMaxHeadingError_deg - kFineReach_deg,
                                           kMaxHeadingError_deg + kFineReach_deg, kCoarseStepDeg);
  const std::vector<Cell> cells = search.Crossed(CellsOf(samples, to_sun), coarse);
  if (static_cast<int>(cells.size()) < kMinCells) return std::nullopt;
  const double about = Best(search.FitAll(cells, coarse), coarse, -1, nullptr);
  const std::vector<double> fine =
      Steps(about - kFineReach_deg, about + kFineReach_deg, kFineStepDeg);
  const Search::Fits fits = search.FitAll(cells, fine);
  std::size_t at = 0;
  const double best = Best(fits, fine, -1, &at);
  const Fit whole = Total(fits[at]);

  // Jackknife (Efron 1982): spread of the results without each group.
  std::array<double, kGroups> offsets{}, contrasts{};
  double offset_sum = 0.0, contrast_sum = 0.0;
  for (int g = 0; g < kGroups; ++g) {
    offsets[g] = Best(fits, fine, g, nullptr);
    contrasts[g] = whole.Without(fits[at][g]).Contrast();
    offset_sum += offsets[g];
    contrast_sum += contrasts[g];
  }
  double offset_spread = 0.0, contrast_spread = 0.0;
  for (int g = 0; g < kGroups; ++g) {
    offset_spread += std::pow(offsets[g] - offset_sum / kGroups, 2);
    contrast_spread += std::pow(contrasts[g] - contrast_sum / kGroups, 2);
  }
  constexpr double kScale = (kGroups - 1.0) / kGroups;
  const double uncertainty_deg =
      std::hypot(std::sqrt(offset_spread * kScale), kFineStepDeg / std::sqrt(12.0));
  const double contrast_error = std::sqrt(contrast_spread * kScale);
  if (whole.cells < kMinCells || whole.Contrast() < kMinContrast ||
      whole.Contrast() < kSignificance * contrast_error || uncertainty_deg > kMaxUncertainty_deg ||
      std::fabs(best) > kMaxHeadingError_deg) {
    return std::nullopt;
  }
  const double sine = std::min(1.0, Dot(Normalized(up), Normalized(to_sun)));
  const double tilt_deg = kTilt_deg * sine / std::sqrt(std::max(1e-6, 1.0 - sine * sine));
  return HeadingEstimate{FromDegrees(best), FromDegrees(std::hypot(uncertainty_deg, tilt_deg)),
                         whole.Contrast(), whole.cells};
}

}  // namespace pleinair::compositor
