#pragma once

#include <optional>

#include "base/utc_time.h"
#include "base/vector.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/photometry/random_walk_filter.h"
#include "compositor/photometry/sky_fit.h"
#include "compositor/photometry/sky_state.h"

namespace pleinair::compositor {

/// Filters the results of light estimation passes over time (RandomWalkFilter). A pass that
/// measures a quantity again is combined with the earlier passes. A pass that measures too little
/// keeps their values. Quantities that no estimate has provided come from the scene description.
class LightFilter {
 public:
  void AddHeading(const HeadingOffset& seen, UtcTime time);
  /// Returns nothing before the first estimate.
  std::optional<HeadingOffset> Heading(UtcTime time) const;

  /// The sun shines, beside a sky of this radiance scale.
  void AddSun(const SkyRadianceScale& seen, UtcTime time);
  /// No sun shines. The sky radiance scale is kept for when the sun shines again.
  void AddClouds() { seen_ = Observed::kClouds; }
  /// True if the newest conclusive pass saw no sun.
  bool ObservedClouds() const { return seen_ == Observed::kClouds; }
  /// Returns nothing before the first sun, or if the newest conclusive pass saw none.
  std::optional<SkyRadianceScale> SkyBesideSun(UtcTime time) const;

  /// Stores a pass's result for sun and sky.
  void Keep(const MeasuredLight& light, const SkyState& skies);
  /// Restores the sources of sun and sky from the last pass that measured them. Changes nothing if
  /// none did.
  void RestoreSources(UtcTime time, MeasuredLight* light) const;
  /// Restores also the stored skies, with their unmodelled shadows. Changes nothing if none were
  /// stored.
  void Recall(UtcTime time, MeasuredLight* light, SkyState* skies) const;

 private:
  enum class Observed { kNothing, kSun, kClouds };

  // A marker does not move, but errors of the phantoms' positions change the estimated heading over
  // the day. A sky changes fast: measured within 6 %, four fifths of an increase by a quarter are
  // accepted at once.
  static constexpr Radians kHeadingDrift = FromDegrees(0.1);
  static constexpr double kLogSkyDrift = 0.1;

  RandomWalkFilter heading_offset_{kHeadingDrift.value()};
  RandomWalkFilter log_sky_{kLogSkyDrift};  // Luminance of the channels' logarithms.
  LinearRgb sky_radiance_scale_{1.0, 1.0, 1.0};
  Observed seen_ = Observed::kNothing;
  std::optional<MeasuredLight> reasons_;  // Only its sun and sky are used.
  SkyState skies_;
};

}  // namespace pleinair::compositor
