#include "compositor/photometry/changes/light_equations.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>
#include <utility>

#include "base/parallel_for.h"

namespace pleinair::compositor {
namespace {

// Standard deviation of the modelled sun over sky that the probes of a plane have in common,
// logarithmic: the sky is not as modelled towards the plane's side. Then that of a single channel.
constexpr double kPlaneSpread = 0.1, kPlaneColorSpread = 0.05;
// Standard deviation of the reference frames' sun over sky, logarithmic.
constexpr double kReferenceSpread = 0.1;
// Precision of the condition that the mean logarithm of the reference frames' light is 0, and of
// each frame's light where nothing is seen.
constexpr double kGauge = 1e6, kAnchor = 1e-4;
// Largest number of steps of conjugate gradients.
constexpr int kMaxSteps = 100;
// Parts into which the probes are divided for threads. Sums over them have a fixed order, so that
// the result is the same on any number of threads.
constexpr std::size_t kParts = 16;

/// Sums `add(probe, sum)` over all probes.
template <typename Sum, typename Add>
Sum SumOver(const std::vector<ProbeFit>& probes, const Sum& zero, const Add& add) {
  std::vector<Sum> sums(kParts, zero);
  ParallelFor(kParts, 0, [&](std::size_t part) {
    for (std::size_t i = part; i < probes.size(); i += kParts) {
      if (!probes[i].empty()) add(probes[i], &sums[part]);
    }
  });
  for (std::size_t part = 1; part < kParts; ++part) sums[0].Add(sums[part], 1.0);
  return std::move(sums[0]);
}

/// What the probes contribute to the equations.
struct Contribution {
  LightUnknowns right;
  std::vector<LogLightMatrix> diagonal;
  std::vector<PlaneError> planes;

  void Add(const Contribution& other, double factor) {
    right.Add(other.right, factor);
    for (std::size_t t = 0; t < diagonal.size(); ++t) diagonal[t] += factor * other.diagonal[t];
    for (std::size_t p = 0; p < planes.size(); ++p) planes[p] += factor * other.planes[p];
  }
};

Eigen::Matrix3d PlanePrior() {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Constant(kPlaneSpread * kPlaneSpread);
  covariance.diagonal().array() += kPlaneColorSpread * kPlaneColorSpread;
  return covariance.inverse();
}

}  // namespace

double LightUnknowns::Dot(const LightUnknowns& other) const {
  double sum = 0.0;
  for (std::size_t t = 0; t < light.size(); ++t) sum += light[t].dot(other.light[t]);
  for (std::size_t p = 0; p < planes.size(); ++p) sum += planes[p].dot(other.planes[p]);
  return sum;
}

void LightUnknowns::Add(const LightUnknowns& other, double factor) {
  for (std::size_t t = 0; t < light.size(); ++t) light[t] += factor * other.light[t];
  for (std::size_t p = 0; p < planes.size(); ++p) planes[p] += factor * other.planes[p];
}

void LightUnknowns::Scale(double factor) {
  for (LogLight& one : light) one *= factor;
  for (PlaneError& one : planes) one *= factor;
}

double LightUnknowns::Largest() const {
  double largest = 0.0;
  for (const LogLight& one : light) largest = std::max(largest, one.lpNorm<Eigen::Infinity>());
  return largest;
}

LightEquations::LightEquations(const std::vector<ProbeFit>& probes, const LightWalk& walk,
                               const std::vector<std::size_t>& reference, const LightUnknowns& now)
    : probes_(probes),
      walk_(walk),
      reference_(reference),
      frame_prior_(ChannelPrior() + LogLightMatrix::Identity() * kAnchor),
      plane_prior_(PlanePrior()),
      right_(now.light.size(), now.planes.size()) {
  const Eigen::Matrix3d ratio = Eigen::Matrix3d::Identity() / (kReferenceSpread * kReferenceSpread);
  reference_prior_ << ratio, -ratio, -ratio, ratio;
  Contribution told = SumOver(
      probes_,
      Contribution{right_, std::vector<LogLightMatrix>(now.light.size(), LogLightMatrix::Zero()),
                   std::vector<PlaneError>(now.planes.size(), PlaneError::Zero())},
      [](const ProbeFit& probe, Contribution* sum) {
        const std::size_t plane = probe.plane();
        probe.AddEquations(&sum->right.light, &sum->right.planes[plane], &sum->diagonal,
                           &sum->planes[plane]);
      });
  right_ = std::move(told.right);
  right_.Add(PriorProduct(now), -1.0);
  told_ = std::move(told.diagonal);
  diagonal_ = told_;
  for (LogLightMatrix& block : diagonal_) block += frame_prior_;
  plane_diagonal_ = std::move(told.planes);
  for (const std::size_t t : reference_) diagonal_[t] += reference_prior_;
  for (PlaneError& plane : plane_diagonal_) plane += plane_prior_.diagonal();
}

void LightEquations::AddPriorNoise(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto sample = [&](const auto& precision) {
    using Matrix = std::decay_t<decltype(precision)>;
    Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1> noise;
    for (double& one : noise) one = normal(random);
    // Root of a matrix that may be singular.
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(precision);
    const auto roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
    return (solver.eigenvectors() * roots.cwiseProduct(noise)).eval();
  };
  const LogLight gauge = sample(LogLightMatrix(LogLightMatrix::Identity() * kGauge));
  for (const std::size_t t : reference_) {
    right_.light[t] += sample(reference_prior_) + gauge / static_cast<double>(reference_.size());
  }
  for (std::size_t t = 0; t < right_.light.size(); ++t) {
    right_.light[t] += sample(frame_prior_);
    if (t + 1 == right_.light.size()) break;
    const LogLight step = sample(walk_.Precision(t));
    right_.light[t] -= step;
    right_.light[t + 1] += step;
  }
  for (PlaneError& plane : right_.planes) plane += sample(plane_prior_);
}

LightUnknowns LightEquations::PriorProduct(const LightUnknowns& x) const {
  LightUnknowns product(x.light.size(), x.planes.size());
  for (std::size_t t = 0; t < x.light.size(); ++t) product.light[t] = frame_prior_ * x.light[t];
  for (std::size_t t = 0; t + 1 < x.light.size(); ++t) {
    const LogLight pull = walk_.Precision(t) * (x.light[t + 1] - x.light[t]);
    product.light[t] -= pull;
    product.light[t + 1] += pull;
  }
  for (std::size_t p = 0; p < x.planes.size(); ++p) product.planes[p] = plane_prior_ * x.planes[p];
  if (reference_.empty()) return product;
  LogLight sum = LogLight::Zero();
  for (const std::size_t t : reference_) sum += x.light[t];
  const auto count = static_cast<double>(reference_.size());
  for (const std::size_t t : reference_) {
    product.light[t] += sum * (kGauge / (count * count)) + reference_prior_ * x.light[t];
  }
  return product;
}

LightUnknowns LightEquations::Product(const LightUnknowns& x) const {
  LightUnknowns product =
      SumOver(probes_, LightUnknowns(x.light.size(), x.planes.size()),
              [&](const ProbeFit& probe, LightUnknowns* sum) {
                const std::size_t plane = probe.plane();
                probe.AddProduct(x.light, x.planes[plane], &sum->light, &sum->planes[plane]);
              });
  product.Add(PriorProduct(x), 1.0);
  return product;
}

LightUnknowns LightEquations::Solve(double end) const {
  const BlockTridiagonal frames(diagonal_, walk_);
  const auto precondition = [&](const LightUnknowns& residual) {
    LightUnknowns solved = residual;
    solved.light = frames.Solve(residual.light);
    for (std::size_t p = 0; p < solved.planes.size(); ++p) {
      solved.planes[p] = solved.planes[p].cwiseQuotient(plane_diagonal_[p]);
    }
    return solved;
  };
  LightUnknowns x(right_.light.size(), right_.planes.size());
  LightUnknowns residual = right_, direction = precondition(residual);
  double size = residual.Dot(direction);
  const double end_size = size * end * end;
  for (int i = 0; i < kMaxSteps && size > end_size; ++i) {
    const LightUnknowns product = Product(direction);
    const double along = size / direction.Dot(product);
    x.Add(direction, along);
    residual.Add(product, -along);
    const LightUnknowns solved = precondition(residual);
    const double next = residual.Dot(solved);
    direction.Scale(next / size);
    direction.Add(solved, 1.0);
    size = next;
  }
  return x;
}

std::vector<LogLightMatrix> LightEquations::Covariance() const {
  return BlockTridiagonal(diagonal_, walk_).InverseBlocks();
}

}  // namespace pleinair::compositor
