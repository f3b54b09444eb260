#pragma once

#include <span>
#include <vector>

#include "compositor/lens/focus_fit.h"

namespace pleinair::compositor {

/// The course of a focus that changes, with the aperture held.
struct FocusCourse {
  double curvature = 0.0, motion = 0.0;  ///< c and e of BlurParabola.
  double own_blur_px = 0.0;              ///< σ₀.
  double start_dioptres = 0.0;           ///< From which a window's focus is searched.

  /// The focus in windows of 2 s. Weights are inverse variances of σ², 0 for readings that do not
  /// count.
  std::vector<FocusAt> Windows(std::span<const BlurReading> readings,
                               std::span<const double> weights) const;
};

/// True where a window's focus differs from that of the one before by four standard errors.
bool HasSteps(const std::vector<FocusAt>& windows);

/// Smooths as a random walk, forwards and backwards (Rauch, Tung, Striebel 1965). Its variance is
/// that of the windows' steps.
void SmoothFocus(std::vector<FocusAt>* windows);

/// The focus at a time, linear between the windows' mean times.
double FocusAtTime(const std::vector<FocusAt>& windows, double time_s);

}  // namespace pleinair::compositor
