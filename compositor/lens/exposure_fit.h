#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "compositor/lens/focus_fit.h"

namespace pleinair::compositor {

/// The time of exposure by the blur of a print's edges across its motion.
struct ExposureFit {
  std::string reason;  ///< Why nothing was measured; empty: measured.
  double exposure_s = 0.0, error_s = 0.0;
  /// Where edges in motion blur no more than others: longer exposures would have shown. Else 0.
  double shorter_than_s = 0.0;
  double longest_streak_px = 0.0;  ///< That of a twentieth of the readings, by the exposure.
  double still_blur_px = 0.0;      ///< Mean of the edges, without motion; 0: not fitted.
  std::size_t readings = 0;        ///< That were used.

  bool is_measured() const { return reason.empty(); }
};

/// Fits the time t of exposure to readings of blur: σ² = a + b q + c q² + (v t)² / 12, with q = 1/z
/// and the speed v across the edge. A motion of length v t is a box with the second moment
/// (v t)²/12. The lens's own blur and its circle of confusion are in the first three terms
/// (BlurParabola). They are free, but for distances that hardly differ. Weights, rounds and errors
/// are those of FitFocus().
///
/// Two tests keep other blur that grows with speed out, such as that of a film's compression. The
/// term of motion has to be three standard errors. So has that of a second fit, in which each frame
/// has a blur of its own, so that only the differences between its sides count. It also refuses
///
/// - where a whole `frame_interval_s` would move no edge by a pixel;
/// - where the blur by motion adds less than 0.1 px to the fastest edges;
/// - where the exposure is longer than the interval.
///
/// Readings in order of frames, with their speeds.
ExposureFit FitExposure(std::span<const BlurReading> readings, double frame_interval_s);

}  // namespace pleinair::compositor
