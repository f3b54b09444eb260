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
  static constexpr int kCount = 101;
  static constexpr double kStep = 0.06, kFirst = -3.0;
  static double At(int i) { return kFirst + kStep * i; }
};
/// A function of that error.
using LevelFunction = std::array<double, LevelGrid::kCount>;

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
  /// Product over a plane's cells of Σ prior × density × level, as a logarithm, for each u; one
  /// result for each of `shades`.
  static std::vector<LevelFunction> OfPlane(std::span<const LightCell* const> cells,
                                            std::span<const CellPrediction> predictions,
                                            std::span<const UnmodelledShade> shades);

  /// Logarithmic likelihood of e, from the planes of one surface. `plane_error`: one standard
  /// deviation of the modelled light on a plane.
  static LevelFunction OfSurface(std::span<const LevelFunction> planes, double plane_error);

  /// Posterior probabilities of a cell's states, at the error u of its plane.
  static std::array<double, kCellStates> StatesOf(const LightCell& cell,
                                                  const CellPrediction& prediction,
                                                  UnmodelledShade shade, double u);

  /// The most probable u of a plane, where its surface's planes have the evidence `planes` and the
  /// exposure scale the error e.
  static double BestLevel(std::span<const LevelFunction> planes, std::size_t plane, double e,
                          double plane_error);
};

/// Logarithm of Σ exp(value) × step of the grid.
double LogSum(const LevelFunction& values);

/// Brightness whose level a cell shows: of its sunny part, or of the shaded one.
double LevelOf(const LightCell& cell);

}  // namespace pleinair::compositor
