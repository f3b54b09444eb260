#pragma once

#include <optional>

#include "base/units.h"

namespace pleinair::compositor {

/// Corrections that each put the sun where the shadows fit. The shadows do not tell which of the
/// two is wrong. At least one is set.
struct SunElsewhere {
  std::optional<Radians> heading_offset;  ///< To be added to the heading, at the described time.
  std::optional<double> later_s;          ///< To be added to the time, at the described heading.
  bool time_fits_better = false;          ///< The time explains more than the heading.
};

/// Evidence of sun and sky in the frames.
struct LightEvidence {
  int frames = 0;          ///< Frames used for the estimate.
  int edges = 0;           ///< Edges of phantoms' shadows.
  int edges_agreeing = 0;  ///< Edges that agree with the sun-to-sky ratio.
  /// SunSkyRatio::share_with_contrast.
  double edges_with_contrast = 0.0;
  /// The shadows fit a sun elsewhere far better; sun_doubtful is then true.
  std::optional<SunElsewhere> sun_elsewhere;
  int shade_places = 0;  ///< Places where the depth of tree shade was measured; for Source::kShade.
};

/// Estimated light of a recording: the sky, the sun-to-sky ratio, and the source of each.
struct MeasuredLight {
  /// kShade: from the depth of tree shade, where no phantom's shadow edge gave a ratio. kMarker:
  /// from a shadow edge on the marker, whatever casts it, where phantoms' edges gave none.
  enum class Source { kDescription, kMeasured, kShade, kMarker, kOverride };
  Source sun_source = Source::kDescription;
  Source heading_source = Source::kDescription;
  bool sun_shines = true;          ///< False also where the frames show an overcast sky.
  double sun_to_sky = 0.0;         ///< Sun's illuminance of level ground over the sky's.
  double sun_to_sky_stated = 0.0;  ///< The same ratio by the scene description.
  /// Relative, one standard deviation. Empty where no ratio was measured.
  std::optional<double> sun_to_sky_error;
  Radians heading_offset;                ///< Added to the described heading.
  std::optional<Radians> heading_error;  ///< One standard deviation. Empty where not measured.
  LightEvidence evidence;
  /// True if no shadow lies where phantoms would cast one, yet there are shadows, or if the shadows
  /// fit a sun elsewhere. Sun, overcast and shaded places are then not estimated.
  bool sun_doubtful = false;
  double shaded = 0.0;  ///< Shaded share of the area that the phantoms leave sunlit.
  /// Direct sunlight over the brightest light on the marker under leaves.
  double marker_shade = 1.0;
};

}  // namespace pleinair::compositor
