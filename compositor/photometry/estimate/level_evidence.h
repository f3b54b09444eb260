#pragma once

#include <array>
#include <span>
#include <vector>

#include "compositor/photometry/estimate/cell_model.h"
#include "compositor/photometry/estimate/light_cell.h"

namespace pleinair::compositor {

/// Logarithmic error of a level: a surface's albedo and the frames' exposure scale together.
class LevelGrid {
 public:
  static constexpr int kCount = 201;
  static constexpr double kStep = 0.03, kFirst = -3.0;
  static double At(int i) { return kFirst + kStep * i; }
};
/// A function of that error.
using LevelFunction = std::array<double, LevelGrid::kCount>;
/// The same of densities, which need neither range nor digits.
using LevelDensity = std::array<float, LevelGrid::kCount>;

/// Evidence of how bright surfaces are, beside what a hypothesis about the light predicts.
///
/// The brightness of a plane's cells gives the error u by which the whole plane differs from its
/// description. A cell of brightness m has the density p(m − open − u) in the open state, where p
/// is the pattern of its material. In the dark state it is p(m − dark − u), in a partial state the
/// mean over everything between.
///
/// All planes of one surface have one albedo error. It has Student's distribution, since
/// descriptions are rough and some are wrong. Each plane has its own small error of the modelled
/// light. All surfaces share the error e of the exposure scale.
class LevelEvidence {
 public:
  /// Σ prior × density × level over a cell's states, for each u; one function for each of `shades`.
  static void OfCell(const LightCell& cell, const CellPrediction& prediction,
                     std::span<const UnmodelledShade> shades, std::span<LevelDensity> by_mix);

  /// Posterior probabilities of a cell's states from their prior ones, at the error u of its plane.
  static std::array<double, kCellStates> StatesOf(const LightCell& cell,
                                                  const CellPrediction& prediction,
                                                  const std::array<double, kCellStates>& prior,
                                                  double u);
};

/// Logarithmic likelihood of the exposure scale's error e, from the planes of one surface.
class SurfaceEvidence {
 public:
  /// `planes`: logarithmic likelihood of each plane's u. `plane_error`: one standard deviation of
  /// the modelled light on a plane.
  SurfaceEvidence(std::vector<LevelFunction> planes, double plane_error);

  double At(double e) const;
  /// Posterior probabilities of a plane's u at the error e.
  LevelFunction LevelsOf(std::size_t plane, double e) const;

 private:
  std::vector<LevelFunction> planes_, blurred_;
  LevelFunction sum_{};  // Over the planes.
  double plane_error_;
};

/// Logarithm of Σ exp(value) × step of the grid.
double LogSum(const LevelFunction& log_values);
/// Probabilities in proportion to exp(value).
LevelFunction Normalized(LevelFunction log_values);

/// Brightness whose level a cell shows: of its sunny part, or of the shaded one.
double LevelOf(const LightCell& cell);

}  // namespace pleinair::compositor
