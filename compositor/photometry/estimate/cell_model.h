#pragma once

#include <array>

#include "compositor/photometry/estimate/light_cell.h"

namespace pleinair::compositor {

/// Lower ends of the bands in which the share of the sun varies beneath leaves. Each band reaches
/// to the next number, the last to the whole sun.
inline constexpr std::array kBands{0.0, 0.1, 0.2, 0.35, 0.55};

/// State of a cell that the phantoms leave sunlit: what unmodelled geometry does to its light.
enum CellState : std::size_t {
  kOpen,      ///< The sun reaches it.
  kPartial,   ///< Any part of the sun reaches it, beside solid things.
  kDivided,   ///< Their full shadow ends in it.
  kMottled,   ///< Their half-light ends in it.
  kStray,     ///< Something else is seen there: an object, a person, a stain.
  kDark,      ///< No sun reaches it, behind something solid.
  kFiltered,  ///< Any part of the sun reaches it, beneath a crown.
  kBand,      ///< A share in the first of kBands reaches it, beneath a crown; then further bands.
};
inline constexpr std::size_t kNearlyOpen = kBand + kBands.size() - 1;
/// All of the sun reaches it through a gap of a crown, which hides a part of its sky.
inline constexpr std::size_t kGap = kNearlyOpen + 1, kCellStates = kGap + 1;

/// What a hypothesis about the light predicts for one cell.
struct CellPrediction {
  /// Brightness of the surface as described: logarithm of cd/m². In the open, behind something
  /// solid, in a gap of a crown, and with each share of kBands beneath a crown. Crowns hide more of
  /// the sky.
  double open = 0.0, dark = 0.0, gap = 0.0;
  std::array<double, kBands.size()> crown{};
  bool in_sun = false;  ///< Unmodelled shade can darken it; all other cells are open.
  /// Probability density of the seen contrast and step in each state.
  std::array<double, kCellStates> density{};
};

/// The sun shines from where the model has it, beside a sky whose radiance is exp(`log_sky_scale`)
/// times the model's. `log_sky_error` is added to that for this cell: the part of the sky that it
/// faces differs from the model.
CellPrediction PredictInSun(const LightCell& cell, double log_sky_scale, double log_sky_error);

/// The same of a cell with a sunny part alone, whose brightness in the open is known.
CellPrediction PredictAtLevel(const LightCell& cell, double open, const LogRgb& log_sky_scale);

/// No sun shines. All cells are open.
CellPrediction PredictUnderClouds(const LightCell& cell);

/// A sun shines from elsewhere: each cell may be in the sun or in shade, whatever the phantoms
/// predict. `sun` is its light on a surface that faces it; the cell is taken for turned halfway.
CellPrediction PredictInOtherSun(const LightCell& cell, LinearRgb sun);

/// How much of what the phantoms leave in the sun lies in unmodelled shade, and what casts it.
/// Solid things leave no sun and sharp ends; leaves let some light through, more or less of it
/// beneath one crown than beneath another.
struct UnmodelledShade {
  double share = 0.0;
  bool leaves = false;
  std::size_t band = 0;  ///< Index into kBands: most of the shade of leaves.
};

/// Shares of the sky that a shadow caster hides: something solid, or a crown. Both are guesses.
inline constexpr double kTakenBySolid = 0.1, kTakenByCrown = 0.2;

/// Prior probabilities of the states of a cell.
std::array<double, kCellStates> StatePrior(const CellPrediction& prediction, UnmodelledShade shade);

/// Light of the open and of the dark state on one part of a cell, beside a sky of this scale.
LinearRgb OpenLight(const LightCell& cell, const CellPart& part, LinearRgb sky_scale);
LinearRgb DarkLight(const CellPart& part, LinearRgb sky_scale);
/// Logarithms of `bright` over `dark`.
LogRgb ContrastOf(LinearRgb bright, LinearRgb dark);

/// One standard deviation of a measured contrast's brightness: the medians' own, a surface's
/// pattern, and geometry and colors of the model.
double ContrastError(const LightCell& cell);

}  // namespace pleinair::compositor
