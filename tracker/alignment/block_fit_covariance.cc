#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "tracker/alignment/block_fit_sums.h"
#include "tracker/alignment/light_elimination.h"

namespace pleinair::tracker {
namespace {

/// Lower limit of the widening by correlated residuals: it is estimated roughly from few cells.
constexpr double kMinWidening = 0.8;
/// Shift of edges that a blur of another shape than the model's may hide; the variance doubles at
/// this value. Chosen on rendered defocus and motion blur, where it was underestimated most.
constexpr double kHiddenShift_px = 0.25;

/// E[ψ'] / E[w] of the robust weight w(z) = (1 + z²)⁻², ψ = w z, for Gaussian residuals of standard
/// deviation z. The equations have w in place of ψ' and overestimate the information by this
/// factor. An M-estimate's variance is E[ψ²] / E[ψ']² (Huber & Ronchetti 2009, section 3.2). 1
/// without noise, 0.31 at z = 1; accurate to 5 % below z = 2.
double KnownShare(double z) { return 1.0 / (1.0 + 3.7 * z * z / (1.0 + 0.55 * z)); }

}  // namespace

// The motions m move the observation at (u, v), in half edges from the centre, by
// (m0 + m1 u + m2 v - (m6 u + m7 v) u, m3 + m4 u + m5 v - (m6 u + m7 v) v).
//
// If the noise of all pixels were equal and independent, the covariance would be σ² H⁻¹. It is not:
// residuals from texture, shadow edges, or a non-Gaussian blur are correlated between neighbouring
// pixels. They occur at the edges that determine the position. A clustered sandwich estimate (Liang
// & Zeger 1986) includes all that: H⁻¹ (Σ_cells g gᵀ) H⁻¹ with g the gradient of each cell of the
// marker. With few cells that matrix is inaccurate; its mean ratio to σ² H⁻¹ is accurate enough,
// and scales σ² H⁻¹.
std::array<double, 64> BlockFit::MotionCovariance() const {
  using Parameters = Eigen::Matrix<double, kParameters, 1>;
  using Square = Eigen::Matrix<double, kParameters, kParameters>;
  using Motions = Eigen::Matrix<double, kMotions, kMotions>;
  double residual = 0.0, count = 0.0;
  double known = 0.0, correlation = 0.0, information_sum = 0.0;
  std::array<BlockElimination, kMaxBlocks> eliminations;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const MarkerBlock& block = blocks_[k];
    const BlockMotions& sum = sums_->motions[k];
    const LightElimination eliminate(sum);
    if (!(block.weight > 0.0) || !eliminate.possible) continue;
    residual += std::max(0.0, sum.rr - eliminate.OnPattern(sum.r, sum.rp) * sum.rp -
                                  eliminate.OnOne(sum.r, sum.rp) * sum.r);
    count += block.pixels * block.weight;
    eliminations[k].possible = true;
    for (int a = 0; a < kParameters; ++a) {
      eliminations[k].on_white[a] = block.gain * eliminate.OnPattern(sum.j[a], sum.pj[a]);
      eliminations[k].on_one[a] = block.gain * eliminate.OnOne(sum.j[a], sum.pj[a]);
    }
    const double informative = block.weight * block.pixels * block.contrast;
    correlation += informative * block.correlation;
    known += informative * KnownShare(block.noise / (block.gain * robustness_.share));
    information_sum += informative;
  }
  Square hessian = Eigen::Map<const Square>(equations_.hessian.data());
  // A parameter that was not fitted is known.
  const bool blur = hessian(kMotions, kMotions) > 0.0;
  if (!blur) hessian(kMotions, kMotions) = 1.0;
  const Square inverse = hessian.ldlt().solve(Square::Identity());
  const double variance = residual / std::max(1.0, count - kParameters);
  const Motions independent = inverse.topLeftCorner<kMotions, kMotions>() * variance;

  CellScores scores;
  sums_->blocks.Scores(grid_.modules, grid_.edge_modules, eliminations, &scores);
  Motions together = Motions::Zero();
  double cells = 0.0;
  for (std::size_t cell = 0; cell < scores.gradient.size(); ++cell) {
    if (scores.tiles[cell] == 0) continue;
    cells += 1.0;
    Parameters gradient = Eigen::Map<const Parameters>(scores.gradient[cell].data());
    if (!blur) gradient[kMotions] = 0.0;
    const Eigen::Matrix<double, kMotions, 1> moved = inverse.topRows<kMotions>() * gradient;
    together.noalias() += moved * moved.transpose();
  }
  // The fit of eight motions has made the residuals smaller than the noise.
  together *= cells / std::max(cells / 6.0, cells - kMotions);
  const double telling = std::max(1e-9, information_sum);
  known = std::max(0.05, known / telling);
  const double widening = independent.ldlt().solve(together).trace() / (kMotions * known * known);

  // An edge of blur b, with a share u of its contrast in the residuals, may be displaced by up to u
  // b. All edges of a kind may be displaced by the same amount, and no sample shows it.
  const double trusted = correlation / telling;
  const double hidden_px = blur_px_ * std::sqrt(std::max(0.0, 1.0 - trusted * trusted));
  const double hidden = hidden_px / kHiddenShift_px;
  std::array<double, 64> covariance{};
  Eigen::Map<Eigen::Matrix<double, kMotions, kMotions, Eigen::RowMajor>> out(covariance.data());
  out = independent * ((std::isfinite(widening) ? std::max(kMinWidening, widening) : 1.0) *
                       (1.0 + hidden * hidden));
  return covariance;
}

}  // namespace pleinair::tracker
