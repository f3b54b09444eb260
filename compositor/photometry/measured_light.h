#pragma once

#include <optional>

#include "base/units.h"

namespace pleinair::compositor {

/// What the frames showed of sun and sky.
struct LightEvidence {
  int frames = 0;          ///< Used for the estimate.
  int edges = 0;           ///< Of phantoms' shadows.
  int edges_agreeing = 0;  ///< With the sun-to-sky ratio.
  /// SunSkyRatio::share_with_contrast.
  double edges_with_contrast = 0.0;
  int shade_places = 0;  ///< That the depth of trees' shade was read from; of Source::kShade.
};

/// The light of a recording's day: which sky, how strong beside the sun, and why we think so.
struct MeasuredLight {
  /// kShade: from how deep the shade of trees is, where no phantom's edge could tell.
  /// kMarker: from a shadow's edge across its print, whatever casts it, where phantoms' could not.
  enum class Source { kDescription, kMeasured, kShade, kMarker, kOverride };
  Source sun_source = Source::kDescription;
  Source heading_source = Source::kDescription;
  bool sun_shines = true;
  double sun_to_sky = 0.0;         ///< Sun's illuminance of level ground over the sky's.
  double sun_to_sky_stated = 0.0;  ///< The same as the scene's words have it.
  /// Relative, one standard deviation; nothing where no ratio was measured.
  std::optional<double> sun_to_sky_error;
  Radians heading_offset;                ///< Added to the stated heading.
  std::optional<Radians> heading_error;  ///< One standard deviation; nothing where not measured.
  LightEvidence evidence;
  /// No shadow lies where phantoms would cast one, yet there are shadows: neither sun nor overcast
  /// is concluded, nor what lies in shade.
  bool sun_doubtful = false;
  double shaded = 0.0;        ///< Share of what the phantoms leave in the sun that lies in shade.
  double marker_shade = 1.0;  ///< Open sunlight over that on the print's brightest under leaves.
};

}  // namespace pleinair::compositor
