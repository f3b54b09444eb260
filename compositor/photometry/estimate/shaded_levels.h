#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "compositor/photometry/estimate/level_evidence.h"
#include "compositor/photometry/estimate/light_cell.h"
#include "compositor/photometry/estimate/shade_field.h"

namespace pleinair::compositor {

/// Estimates the levels of all surfaces together with the unmodelled shade on all cells, under one
/// hypothesis about the light.
///
/// Each depends on the other, so they are found in turn. This is done at one error of the exposure
/// scale after the other; the result at one is the start of the next.
class ShadedLevels {
 public:
  /// Prediction of a cell where the sky before its plane is brighter by this logarithm.
  using Predict = std::function<CellPrediction(const LightCell&, double log_sky_error)>;
  /// Errors of the sky before a plane, and their probabilities; sums replace the integral.
  struct SkyError {
    double log = 0.0, probability = 1.0;
  };

  /// `sky_errors`: of a plane that is not level. `field` may be nullptr with a single mix.
  ShadedLevels(const std::vector<LightCell>& cells, const ShadeField* field, Vec3 up,
               std::span<const UnmodelledShade> mixes, std::span<const SkyError> sky_errors,
               double plane_error, const Predict& predict);

  /// Logarithmic likelihood of each error e of the exposure scale, where all mixes are as probable
  /// on each cell, whatever is around it.
  LevelFunction Uncoupled() const;
  /// Logarithmic pseudo-likelihood of one error, by the mixes around each cell (Besag 1975). It is
  /// the product over the cells of the density of each, given what its neighbours show.
  double At(double e);

  // After At(e).
  /// Prior probabilities of a cell's states by the shade around it.
  std::array<double, kCellStates> StatePriorOf(std::size_t cell,
                                               const CellPrediction& prediction) const;
  /// Expected share of unmodelled shade where the marker lies.
  double ShareOnMarker() const;
  /// The most probable error u of a cell's plane.
  double LevelErrorOf(std::size_t cell) const { return level_errors_[cell]; }

 private:
  struct Plane {
    std::vector<std::size_t> cells;
    std::vector<SkyError> sky_errors;
    std::vector<std::vector<LevelDensity>> tables;  // [sky error][cell of the plane × mixes + mix]
  };
  /// Densities of a plane's cells at their present prior, summed over the mixes.
  struct Densities {
    std::vector<std::vector<LevelDensity>> cells;      // [sky error][cell of the plane]
    std::vector<LevelFunction> sky_error_given_level;  // Probabilities.
    LevelFunction log{};                               // Logarithmic likelihood of u.
  };
  using SurfaceDensities = std::vector<Densities>;  // One a plane.

  Densities DensitiesOf(const Plane& plane) const;
  SurfaceEvidence EvidenceOf(const std::vector<Plane>& planes, SurfaceDensities* densities) const;
  /// Stores the posterior probabilities of the mixes on a plane's cells.
  void ExplainCells(const Plane& plane, const Densities& densities, const LevelFunction& levels,
                    std::vector<double>* posterior) const;
  double Step(double e);

  const ShadeField* field_;
  std::span<const UnmodelledShade> mixes_;
  double plane_error_;
  std::map<int, std::vector<Plane>> surfaces_;
  std::vector<double> prior_;  // Rows of mixes, as in ShadeField.
  std::vector<double> level_errors_;
};

}  // namespace pleinair::compositor
