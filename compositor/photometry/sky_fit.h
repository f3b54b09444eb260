#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "base/units.h"
#include "base/vector.h"
#include "compositor/photometry/heading_from_shadows.h"
#include "compositor/photometry/sun_sky_ratio.h"
#include "scene/scene_description.h"
#include "sky/sky_model.h"
#include "sky/sun/sun_position.h"

namespace pleinair::compositor {

/// Of a sun in the blackest sky that there is: high mountains have 10.
inline constexpr double kMaxSunToSky = 20.0;

/// What the user says of the light, in place of what the frames show.
struct LightOverrides {
  /// Measure nothing but the exposure scale and whether trees shade the ground: believe the scene.
  bool as_described = false;
  std::optional<double> sun_to_sky;  ///< Sun's illuminance of level ground over the sky's; 0: none.
  std::optional<double> heading_deg;  ///< Of the marker, as in the scene.
  /// Where light is gathered, at most (LightSolverOptions).
  std::optional<std::size_t> max_patches;
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
  int frames = 0;                        ///< Looked at.
  int edges = 0, edges_agreeing = 0;
  double edges_with_contrast = 0.0;  ///< SunSkyRatio::share_with_contrast.
  int shade_places = 0;              ///< That the depth of trees' shade was read from; of kShade.
  /// No shadow lies where phantoms would cast one, yet there are shadows: neither sun nor overcast
  /// is concluded, nor what lies in shade.
  bool sun_doubtful = false;
  double shaded = 0.0;        ///< Share of what the phantoms leave in the sun that lies in shade.
  double marker_shade = 1.0;  ///< Open sunlight over that on the print's brightest under leaves.
};

/// The skies of a day whose light was measured.
struct SkyFit {
  std::shared_ptr<const sky::SkySource> skies;
  LinearRgb sky_radiance_scale{1.0, 1.0, 1.0};  ///< To multiply the sky with, the sun stays.
};

/// The skies that the scene's words stand for.
std::shared_ptr<const sky::SkySource> DescribedSky(const scene::SceneDescription& scene);
/// The same with a sun, whatever the words: what a shadow's edge is measured against.
std::shared_ptr<const sky::SkySource> SunlitSky(const scene::SceneDescription& scene);
std::shared_ptr<const sky::SkySource> OvercastSky();

/// The sky whose light on level ground, a channel, is `sky_over_sun` times the sun's light on a
/// surface facing it: haze and then clouds are added until the luminances agree, so that the shape
/// of the sky follows; what a channel still lacks goes into `sky_radiance_scale`.
SkyFit SkyWithShare(LinearRgb sky_over_sun, Direction<World> to_sun, double sun_distance_au);
/// The same, of a day's model with the sky so much stronger beside the sun.
SkyFit SkyScaledBesideSun(const sky::SkyModel& day, LinearRgb scale, double sun_distance_au);

/// The sky that the user gives for a sun; nothing where he says nothing of it.
std::optional<SkyFit> OverriddenSky(const scene::SceneDescription& scene,
                                    const LightOverrides& overrides, const sky::SunPosition& sun);

/// How much stronger the sky is beside the sun than SunlitSky() has it.
struct SkyRadianceScale {
  LinearRgb scale{1.0, 1.0, 1.0};
  double relative_error = 0.0;  ///< One standard deviation.
};

/// A measured scale, weighed against how sure the scene's words are.
SkyRadianceScale WeightedScale(const SunSkyRatio& estimate, scene::Cloudiness stated);

/// What is to be added to a stated heading.
struct HeadingOffset {
  Radians offset;
  Radians error;  ///< One standard deviation.
};

/// A measured turn of the heading, weighed against a compass.
HeadingOffset WeightedHeading(const HeadingEstimate& estimate);

/// Sun on level ground over sky.
double SunToSky(const sky::SkyModel& day);

}  // namespace pleinair::compositor
