#pragma once

#include "base/vector.h"
#include "compositor/photometry/estimate/level_evidence.h"
#include "compositor/photometry/estimate/light_cell.h"

namespace pleinair::compositor {

/// Light on the marker as the models have it: lux, linear Rec.709.
struct MarkerLight {
  LinearRgb predicted;  ///< The unit of the samples (MarkerLightMeter); black: there is none.
  CellLight from;
  LinearRgb sun;         ///< Black where phantoms shade the marker.
  bool dappled = false;  ///< Its light is uneven in most frames.
};

/// Constrains the frames' exposure scale by the marker. If its brightest part has the light L where
/// the samples' unit has P, the scale has the error e = log P − log L. L is the sum of skylight,
/// reflected light, and the share v of the sun. v is 1 or 0, or lies between where unmodelled
/// geometry shades the marker.
class MarkerExposure {
 public:
  /// `sky`: all light but the sun's. `shaded`: the expected share of unmodelled shade where the
  /// marker lies. `taken`: the mean share of `sky` that its caster hides there.
  MarkerExposure(const MarkerLight& marker, LinearRgb sky, LinearRgb sun, double shaded,
                 double taken);

  /// Logarithmic prior density of e; flat without a marker.
  double LogPrior(double e) const;
  /// Logarithm of the unshaded light on the marker over that on its brightest part, at the error e.
  /// Returns 0 where all of the sun is the most probable.
  double LogShade(double e) const;

 private:
  double Density(double e, LinearRgb light) const;
  double ShadedDensity(double e) const;

  bool known_ = false;
  double predicted_ = 0.0;
  LinearRgb sky_, sun_;
  double taken_ = 0.0;
  double open_ = 0.0, half_ = 0.0, dark_ = 1.0;  // Prior probabilities; half_: of each share.
};

}  // namespace pleinair::compositor
