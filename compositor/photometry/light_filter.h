#pragma once

#include <optional>

#include "base/utc_time.h"
#include "base/vector.h"
#include "compositor/photometry/measured_light.h"
#include "compositor/photometry/random_walk_filter.h"
#include "compositor/photometry/sky_fit.h"
#include "compositor/photometry/sky_state.h"

namespace pleinair::compositor {

/// What looks at frames have told of the light so far. A look that measures again is smoothed by
/// the earlier ones (RandomWalkFilter); one that sees too little leaves theirs as they were. Only
/// what none has told yet is left to the scene's words.
class LightFilter {
 public:
  void AddHeading(const HeadingOffset& seen, UtcTime time);
  /// Nothing before the first reading.
  std::optional<HeadingOffset> Heading(UtcTime time) const;

  /// The sun shines, beside a sky of this strength.
  void AddSun(const SkyRadianceScale& seen, UtcTime time);
  /// No sun shines. The sky's strength beside it is kept for when it shines again.
  void AddClouds() { seen_ = Observed::kClouds; }
  /// Whether the newest look that told saw no sun.
  bool ObservedClouds() const { return seen_ == Observed::kClouds; }
  /// Nothing before the first sun, and where the newest look that told saw none.
  std::optional<SkyRadianceScale> SkyBesideSun(UtcTime time) const;

  /// Keeps what a look concluded of sun and sky.
  void Keep(const MeasuredLight& light, const SkyState& skies);
  /// Why sun and sky are as the last look found that measured them; nothing where none did.
  void RestoreSources(UtcTime time, MeasuredLight* light) const;
  /// Also the skies that were kept, with the shade of trees; nothing where none were.
  void Recall(UtcTime time, MeasuredLight* light, SkyState* skies) const;

 private:
  enum class Observed { kNothing, kSun, kClouds };

  // A marker stays where it lies, but places of phantoms that are a little wrong tell another
  // heading at another hour. A sky changes fast: measured within 6 %, a quarter more light counts
  // for four fifths at once.
  static constexpr Radians kHeadingDrift = FromDegrees(0.1);
  static constexpr double kLogSkyDrift = 0.1;

  RandomWalkFilter heading_offset_{kHeadingDrift.value()};
  RandomWalkFilter log_sky_{kLogSkyDrift};  // Luminance of the channels' logarithms.
  LinearRgb sky_radiance_scale_{1.0, 1.0, 1.0};
  Observed seen_ = Observed::kNothing;
  std::optional<MeasuredLight> reasons_;  // Of its sun and sky alone.
  SkyState skies_;
};

}  // namespace pleinair::compositor
