#include "compositor/leaf/leaf_inversion.h"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "compositor/leaf/prospect.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kUnknowns = scene::kLeafQuantities.size();
constexpr std::size_t kStructureIndex = kUnknowns - 1;
static_assert(kUnknowns == kLeafConstituents + 1);

/// Contents as shares of their largest values: unknowns of like size.
using ScaledContents = std::array<double, kUnknowns>;

scene::LeafContents ContentsOf(const double* scaled) {
  scene::LeafContents contents;
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    const scene::LeafQuantity& quantity = scene::kLeafQuantities[i];
    contents.*quantity.value = scaled[i] * quantity.high;
  }
  return contents;
}

/// Modelled minus measured values: all reflectances, then all transmittances.
class SpectrumResiduals : public ceres::CostFunction {
 public:
  explicit SpectrumResiduals(const MeasuredSpectrum& spectrum) : spectrum_(spectrum) {
    bands_.reserve(spectrum.wavelength_nm.size());
    for (const double nm : spectrum.wavelength_nm) bands_.push_back(InterpolatedLeafBand(nm));
    set_num_residuals(
        static_cast<int>(spectrum.reflectance.size() + spectrum.transmittance.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(kUnknowns));
  }

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override {
    const scene::LeafContents contents = ContentsOf(parameters[0]);
    double* jacobian = jacobians != nullptr ? jacobians[0] : nullptr;
    const std::size_t reflectances = spectrum_.reflectance.size();
    for (std::size_t i = 0; i < bands_.size(); ++i) {
      const double depth = OpticalDepth(bands_[i], contents);
      const LeafOptics at = StackOptics(bands_[i], depth, contents.structure);
      const Slopes slopes = jacobian != nullptr ? SlopesAt(i, depth, contents.structure) : Slopes{};
      const auto fill = [&](std::size_t row, double modelled, double measured,
                            double LeafOptics::*side) {
        residuals[row] = modelled - measured;
        if (jacobian == nullptr) return;
        for (std::size_t k = 0; k < kLeafConstituents; ++k) {
          jacobian[row * kUnknowns + k] =
              slopes.by_depth.*side * bands_[i].absorption[k] * scene::kLeafQuantities[k].high;
        }
        jacobian[row * kUnknowns + kStructureIndex] =
            slopes.by_structure.*side * scene::kLeafQuantities[kStructureIndex].high;
      };
      if (reflectances != 0) {
        fill(i, at.reflectance, spectrum_.reflectance[i], &LeafOptics::reflectance);
      }
      if (!spectrum_.transmittance.empty()) {
        fill(reflectances + i, at.transmittance, spectrum_.transmittance[i],
             &LeafOptics::transmittance);
      }
    }
    return true;
  }

 private:
  struct Slopes {
    LeafOptics by_depth, by_structure;
  };

  // One-sided at depth 0 and structure 1, where the model ends.
  Slopes SlopesAt(std::size_t band, double depth, double structure) const {
    constexpr double kStep = 1e-5;
    const auto slope = [&](double depth_low, double depth_high, double n_low, double n_high) {
      const LeafOptics low = StackOptics(bands_[band], depth_low, n_low);
      const LeafOptics high = StackOptics(bands_[band], depth_high, n_high);
      const double step = depth_high - depth_low + n_high - n_low;
      return LeafOptics{(high.reflectance - low.reflectance) / step,
                        (high.transmittance - low.transmittance) / step};
    };
    return {slope(std::max(0.0, depth - kStep), depth + kStep, structure, structure),
            slope(depth, depth, std::max(1.0, structure - kStep), structure + kStep)};
  }

  const MeasuredSpectrum& spectrum_;
  std::vector<LeafBand> bands_;
};

/// Whether the wavelengths show a constituent at all: its largest content changes them visibly.
bool IsDetermined(const MeasuredSpectrum& spectrum, std::size_t unknown) {
  if (unknown == kStructureIndex) return true;
  constexpr double kVisibleDepth = 1e-3;
  return std::ranges::any_of(spectrum.wavelength_nm, [&](double nm) {
    return InterpolatedLeafBand(nm).absorption[unknown] * scene::kLeafQuantities[unknown].high >
           kVisibleDepth;
  });
}

using DeterminedUnknowns = std::array<bool, kUnknowns>;

/// Fits from one start. Returns the cost, or nothing if it does not converge.
std::optional<double> FitFrom(const SpectrumResiduals& residuals, const DeterminedUnknowns& used,
                              ScaledContents* scaled) {
  ceres::Problem::Options owner;
  owner.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(owner);
  // Ceres takes a cost that it could own; this one it only evaluates.
  problem.AddResidualBlock(const_cast<SpectrumResiduals*>(&residuals), nullptr, scaled->data());
  std::vector<int> fixed;
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    const scene::LeafQuantity& quantity = scene::kLeafQuantities[i];
    const int index = static_cast<int>(i);
    if (!used[i]) fixed.push_back(index);
    problem.SetParameterLowerBound(scaled->data(), index, quantity.low / quantity.high);
    problem.SetParameterUpperBound(scaled->data(), index, 1.0);
  }
  if (!fixed.empty()) {
    problem.SetManifold(scaled->data(),
                        new ceres::SubsetManifold(static_cast<int>(kUnknowns), fixed));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-10;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return std::nullopt;
  return summary.final_cost;
}

/// Standard deviations s² (JᵀJ)⁻¹ of the unknowns in use.
void EstimateDeviations(const SpectrumResiduals& residuals, const DeterminedUnknowns& used,
                        const ScaledContents& scaled, LeafFit* fit) {
  const auto rows = static_cast<Eigen::Index>(residuals.num_residuals());
  Eigen::VectorXd values(rows);
  Eigen::Matrix<double, Eigen::Dynamic, kUnknowns, Eigen::RowMajor> jacobian(rows, kUnknowns);
  const double* parameters = scaled.data();
  double* jacobians = jacobian.data();
  residuals.Evaluate(&parameters, values.data(), &jacobians);
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    if (used[i]) columns.push_back(static_cast<Eigen::Index>(i));
  }
  const auto count = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd reduced(rows, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    reduced.col(i) = jacobian.col(columns[static_cast<std::size_t>(i)]);
  }
  const Eigen::MatrixXd inverse =
      (reduced.transpose() * reduced).ldlt().solve(Eigen::MatrixXd::Identity(count, count));
  const double squares = values.squaredNorm();
  const double variance = squares / static_cast<double>(std::max<Eigen::Index>(1, rows - count));
  fit->rms = std::sqrt(squares / static_cast<double>(rows));
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto unknown = static_cast<std::size_t>(columns[static_cast<std::size_t>(i)]);
    const double deviation =
        std::sqrt(variance * inverse(i, i)) * scene::kLeafQuantities[unknown].high;
    // A content that is uncertain by its whole range is not determined.
    if (std::isfinite(deviation) && deviation < scene::kLeafQuantities[unknown].high) {
      fit->deviations[unknown] = deviation;
    }
  }
}

// Pale, green and dark; thin and thick. Elsewhere the cost has one minimum.
constexpr std::array<scene::LeafContents, 4> kStarts = {{
    {5.0, 3.0, 1.0, 0.1, 0.01, 0.004, 1.3},
    {35.0, 8.0, 1.0, 0.1, 0.012, 0.006, 1.5},
    {80.0, 18.0, 2.0, 0.1, 0.02, 0.010, 2.0},
    {30.0, 8.0, 10.0, 1.0, 0.03, 0.015, 2.8},
}};

}  // namespace

Result<LeafFit> FitLeaf(const MeasuredSpectrum& spectrum, const std::string& where) {
  const std::set<double> distinct(spectrum.wavelength_nm.begin(), spectrum.wavelength_nm.end());
  if (distinct.size() < kMinFittedBands) {
    return InputError(where,
                      "has " + std::to_string(distinct.size()) + " wavelengths from 400 to 2500 nm",
                      "give at least " + std::to_string(kMinFittedBands));
  }
  const SpectrumResiduals residuals(spectrum);
  DeterminedUnknowns used{};
  for (std::size_t i = 0; i < kUnknowns; ++i) used[i] = IsDetermined(spectrum, i);
  std::optional<double> best_cost;
  ScaledContents best{};
  for (const scene::LeafContents& start : kStarts) {
    ScaledContents scaled{};
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      const scene::LeafQuantity& quantity = scene::kLeafQuantities[i];
      if (used[i]) scaled[i] = start.*quantity.value / quantity.high;
    }
    const std::optional<double> cost = FitFrom(residuals, used, &scaled);
    if (!cost || (best_cost && *cost >= *best_cost)) continue;
    best_cost = cost;
    best = scaled;
  }
  if (!best_cost) {
    return InputError(where, "is no spectrum of a leaf: the fit does not converge",
                      "check its wavelengths and values");
  }
  LeafFit fit;
  fit.contents = ContentsOf(best.data());
  EstimateDeviations(residuals, used, best, &fit);
  return fit;
}

}  // namespace pleinair::compositor
