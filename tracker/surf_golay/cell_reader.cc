#include "tracker/surf_golay/cell_reader.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace pleinair::tracker {
namespace {

/// Deviation of a cell's share that no noise tells: uneven light, ink, the blur's shape.
constexpr double kSystematicShare = 0.07;
/// Prior probability that a cell is covered, and density of what is then seen.
constexpr double kCoveredPrior = 0.08, kCoveredDensity = 0.4;
/// Left-over inside a cell, in shares, at which it is as likely covered as not.
constexpr double kUnevenShare = 0.16;
/// White brighter than this clips: a clipped pixel is white there, and glare elsewhere.
constexpr double kWhiteClips = 0.8;
constexpr float kClippedValue = 0.975F;
constexpr double kRidge = 1e-4;

double NormalBelow(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// Shares of a blurred pixel along one axis that fall into each of the cells' columns.
void ColumnShares(double at, double sigma, std::array<double, sg::kCells>* shares) {
  double below = NormalBelow((sg::kQuiet + sg::kContent - at) / sigma);
  for (int i = 0; i < sg::kCells; ++i) {
    const double next = NormalBelow((sg::kQuiet + sg::kContent + (i + 1) * sg::kCell - at) / sigma);
    (*shares)[i] = next - below;
    below = next;
  }
}

}  // namespace

void CellReader::Read(const PrintPattern& blank, const BlockFit& fit, const SeenWindow& seen,
                      const BlockFitState& state, const PrintLight& light, CellReading* reading) {
  using Matrix = Eigen::Matrix<double, sg::kCodeCells, sg::kCodeCells>;
  using Vector = Eigen::Matrix<double, sg::kCodeCells, 1>;
  *reading = CellReading{};
  pixels_.clear();
  const double blur = state.blur_px / seen.rays.window.Scale();
  const double variance_px2 = blur * blur + 1.0 / 12.0;
  const double middle = 0.5 * blank.modules, per_half = 2.0 / blank.edge_modules;
  const double reach_modules = 0.5 * sg::kCells * sg::kCell;
  Matrix normal = Matrix::Zero();
  Vector right = Vector::Zero();
  for (std::size_t n = 0; n < seen.value.size(); ++n) {
    const double c = fit.map().column[n], r = fit.map().row[n];
    const double sigma_c =
        std::sqrt(variance_px2) * std::hypot(fit.map().column_x[n], fit.map().column_y[n]);
    const double sigma_r =
        std::sqrt(variance_px2) * std::hypot(fit.map().row_x[n], fit.map().row_y[n]);
    if (!(std::fabs(c - middle) < reach_modules + sigma_c &&
          std::fabs(r - middle) < reach_modules + sigma_r)) {
      continue;
    }
    const double u = (c - middle) * per_half, v = (r - middle) * per_half;
    const double white = light.White(u, v), black = light.black_share * white;
    double value = seen.value[n];
    if (value >= kClippedValue) {
      if (white < kWhiteClips) continue;
      value = white;
    }
    // Shot noise rises with light; the dark side of a shadow is the surer one.
    const double noise = 0.01 * white + 0.003;
    Pixel pixel;
    pixel.value = static_cast<float>((value - black) / (white - black) - fit.picture().white[n]);
    pixel.weight = static_cast<float>((white - black) * (white - black) / (noise * noise));
    std::array<double, sg::kCells> columns{}, rows{};
    ColumnShares(c, sigma_c, &columns);
    ColumnShares(r, sigma_r, &rows);
    for (int j = 0; j < sg::kCells; ++j) {
      if (rows[j] < 0.02) continue;
      for (int i = 0; i < sg::kCells; ++i) {
        const double share = rows[j] * columns[i];
        const int cell = sg::CodeCell(i, j);
        if (share < 0.02 || cell < 0 || pixel.cells == 9) continue;
        pixel.cell[pixel.cells] = static_cast<std::int8_t>(cell);
        pixel.share[pixel.cells++] = static_cast<float>(share);
      }
    }
    if (pixel.cells == 0) continue;
    for (int a = 0; a < pixel.cells; ++a) {
      const double weighted = static_cast<double>(pixel.weight) * pixel.share[a];
      right[pixel.cell[a]] += weighted * pixel.value;
      for (int b = 0; b < pixel.cells; ++b) {
        normal(pixel.cell[a], pixel.cell[b]) += weighted * pixel.share[b];
      }
    }
    pixels_.push_back(pixel);
  }
  if (pixels_.empty()) return;
  const double ridge = kRidge * normal.trace() / sg::kCodeCells + 1e-9;
  normal.diagonal().array() += ridge;
  right.array() += 0.5 * ridge;
  const auto factors = normal.ldlt();
  const Vector white = factors.solve(right);
  const Matrix inverse = factors.solve(Matrix::Identity());
  if (!white.allFinite()) return;

  // What is left over, cell by cell, against the ideal of a cell that is black or white.
  std::array<double, sg::kCodeCells> left{}, seen_share{};
  double noise = 0.0, count = 0.0;
  for (const Pixel& pixel : pixels_) {
    double predicted = 0.0;
    for (int a = 0; a < pixel.cells; ++a) predicted += pixel.share[a] * white[pixel.cell[a]];
    const double error = pixel.value - predicted;
    noise += pixel.weight * error * error;
    count += 1.0;
    for (int a = 0; a < pixel.cells; ++a) {
      left[pixel.cell[a]] += pixel.share[a] * error * error;
      seen_share[pixel.cell[a]] += pixel.share[a];
    }
  }
  noise /= count;
  for (int k = 0; k < sg::kCodeCells; ++k) {
    const double w = white[k];
    const double variance = inverse(k, k) * std::max(1.0, noise);
    reading->white[k] = static_cast<float>(w);
    reading->deviation[k] = static_cast<float>(std::sqrt(variance));
    if (!(seen_share[k] > 0.05)) continue;
    const double misfit = std::sqrt(left[k] / seen_share[k]);
    reading->misfit[k] = static_cast<float>(misfit);
    // Noise that is everywhere is no sign of a cover.
    const double expected = kUnevenShare * kUnevenShare;
    const double uneven = misfit * misfit / expected;
    const double covered = std::min(0.95, kCoveredPrior * std::exp(2.5 * uneven));
    const double sigma2 = kSystematicShare * kSystematicShare + variance;
    const auto density = [&](double ideal) {
      const double z2 = (w - ideal) * (w - ideal) / sigma2;
      return (1.0 - covered) * std::exp(-0.5 * z2) / std::sqrt(2.0 * std::numbers::pi * sigma2) +
             covered * kCoveredDensity;
    };
    reading->likelihoods[k] = static_cast<float>(std::log(density(1.0) / density(0.0)));
  }
}

}  // namespace pleinair::tracker
