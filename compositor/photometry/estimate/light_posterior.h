#pragma once

#include <array>
#include <vector>

#include "base/vector.h"
#include "compositor/photometry/estimate/cell_model.h"
#include "compositor/photometry/estimate/light_cell.h"
#include "compositor/photometry/estimate/light_prior.h"
#include "compositor/photometry/estimate/marker_exposure.h"

namespace pleinair::compositor {

/// Inputs of the fit besides the cells.
struct LightFitInput {
  MarkerLight marker;
  LinearRgb sun;  ///< On a surface that faces it: lux.
  Vec3 up;        ///< Unit, marker coordinates.
  Vec3 to_sun;    ///< Unit, marker coordinates.
  LightPrior prior;
};

/// Estimate of unmodelled shadow on one cell that the phantoms leave sunlit.
struct CellShade {
  double shaded = 0.0;  ///< Probability that unmodelled things shade it or a part of it.
  double level = 0.0;   ///< Brightness of its surface in the sun, as the samples have it.
  double depth = 0.0;   ///< By how much it is darker in shade, logarithmic.
  /// Probabilities of its states by the shade around it.
  std::array<double, kCellStates> states_around{};
};

/// Numbers of cells from which the light was estimated.
struct CountedCells {
  int edges = 0;           ///< Edges of phantoms' shadows that could show a contrast.
  int edges_agreeing = 0;  ///< Those on which the sun's full contrast is probable.
  int marker_steps = 0;    ///< Cells of the marker that a shadow probably divides.
  int shaded_places = 0;   ///< Cells that are probably shaded.
  double contrast = 0.0;   ///< Expected share of the edges with contrast.
};

/// Sun and sky after the frames.
struct LightPosterior {
  double sun = 0.0, clouds = 0.0, elsewhere = 0.0;  ///< Probabilities, as in LightPrior.
  /// Sky radiance scale: the sky's radiance beside the sun over the model's, if the sun shines.
  /// Mean of its logarithm, per channel, and one standard deviation.
  LogRgb log_sky{};
  double log_sky_error = 0.0;
  std::vector<CellShade> shade;  ///< One per cell; zeros where phantoms shade it.
  double shaded = 0.0;           ///< Share of these cells that are shaded.
  /// Logarithm of the unshaded light on the marker over what its brightest part has; 0 or more.
  double log_marker_shade = 0.0;
  CountedCells counted;
};

/// Estimates sun and sky from the cells: the posterior mean of the sky's logarithmic scale, and its
/// standard deviation (docs/method/light-fit.md).
///
/// Three hypotheses are compared by their evidence: the sun shines as modelled, clouds hide it, or
/// a sun shines from elsewhere. The evidence is a product over surfaces of their levels
/// (LevelEvidence) and contrasts (cell_model.h). Under the sun it is integrated over the sky's
/// scale, the kind of unmodelled shade, and its share on each surface. The marker binds the
/// exposure scale.
LightPosterior FitLight(const std::vector<LightCell>& cells, const LightFitInput& input);

}  // namespace pleinair::compositor
