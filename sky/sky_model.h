#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "base/units.h"
#include "base/vector.h"
#include "sky/atmosphere/aerosol.h"
#include "sky/color.h"

namespace pleinair::sky {

/// The light of one moment: sun and sky, in linear Rec.709 with absolute photometric scale:
/// radiance in cd/m², irradiance in lux, so that Luminance(rgb) is the photometric figure. No
/// channel is ever negative, nothing is NaN, whatever the sun's height. Safe to ask from several
/// threads at once.
class SkyModel {
 public:
  virtual ~SkyModel() = default;

  /// Sky radiance (without the sun's disc) from a direction of the upper hemisphere, a unit vector
  /// east, north, up; zero below the horizon.
  virtual LinearRgb SkyRadiance(Direction<World> from) const = 0;

  /// Luminance (cd/m²) and CIE 1931 chromaticity in a direction. Unlike SkyRadiance() the
  /// chromaticity may lie outside Rec.709's gamut; the luminance is the same.
  virtual XyY At(Direction<World> from) const { return XyYFromRgb(SkyRadiance(from)); }

  /// The sun's illuminance on a surface facing it; zero when its disc is below the horizon.
  virtual LinearRgb SunNormalIrradiance() const = 0;

  /// The sky's illuminance on level ground.
  virtual LinearRgb SkyHorizontalIrradiance() const = 0;

  /// To the sun as seen through the air.
  virtual Direction<World> ToSun() const = 0;

  /// What the air between the eye and a thing does to the thing's light: see
  /// sky/atmosphere/aerial_perspective.h. Nothing, with the models that have no air (kPerez, kCie).
  struct AirBetween {
    LinearRgb transmittance{1.0, 1.0, 1.0};
    LinearRgb inscattered;  ///< cd/m².
  };
  virtual AirBetween AirTo(Direction<World> /*towards*/, Metres /*distance*/) const { return {}; }

  /// What was asked for and could not be had as such, for people: "turbidity 1.5 is outside …".
  virtual std::vector<std::string> Notes() const { return {}; }
};

enum class SkyModelKind {
  kAtmosphere,  ///< Physically based, sky/atmosphere/atmosphere.h.
  kPerez,       ///< Preetham's form of Perez, sky/perez.h.
  kCie,         ///< One of the CIE standard general skies, sky/cie_sky.h.
};

/// A model as a person names it: "atmosphere", "perez" or "cie:1" to "cie:15".
struct SkyModelName {
  SkyModelKind kind = SkyModelKind::kAtmosphere;
  int cie_type = 0;  ///< 1…15 with kCie.
  bool operator==(const SkyModelName&) const = default;
};

/// Errors: an unknown model, a CIE type outside 1…15 (input).
Result<SkyModelName> ParseSkyModelName(std::string_view name);
std::string ToString(SkyModelName name);

inline constexpr double kMinTurbidity = 1.0;   ///< Air without any aerosol.
inline constexpr double kMaxTurbidity = 30.0;  ///< Thick haze, 3 km of sight.
/// An ordinary clear day: with it the diffuse share of the light on level ground under kAtmosphere
/// is within 5 % of IES' clear-sky share for suns of 10° to 70°
/// (tests/sky/atmosphere/atmosphere_test.cc).
inline constexpr double kDefaultTurbidity = 1.8;

/// The air and the clouds; everything but the sun.
struct SkyConditions {
  /// kMinTurbidity…kMaxTurbidity; a model with a narrower range clamps and says so in
  /// Notes(). Default: kDefaultTurbidity, 2.5 for kPerez. Without effect on kCie.
  std::optional<double> turbidity;
  /// The aerosol itself, in place of the one that `turbidity` stands for; kAtmosphere only.
  std::optional<Aerosol> aerosol;
  /// Diffuse reflectance of the land all around, 0…1; kAtmosphere only.
  double ground_albedo = 0.15;
  /// 0 clear … 1 overcast (sky/cloud_cover.h). Must be 0 with kCie, whose type says it.
  double cloud_cover = 0.0;
  /// Scale of a kCie sky; at most one of them. Without: IES' illuminance for the type's clouds.
  std::optional<CandelaPerM2> zenith_luminance;
  std::optional<Lux> sky_horizontal_illuminance;
};

/// Makes the skies of one model and one air for any place of the sun, and keeps what does not
/// depend on it (tables of kAtmosphere), so that following the sun is cheap. Safe to use from
/// several threads at once.
class SkySource {
 public:
  /// Errors: a value outside its range or without meaning for the model (input).
  static Result<std::shared_ptr<const SkySource>> Create(SkyModelName name,
                                                         const SkyConditions& conditions);
  virtual ~SkySource() = default;

  /// The sky of a moment. `to_sun`: unit vector east, north, up to the apparent (refracted) sun,
  /// below the horizon too; `sun_distance_au` its distance in astronomical units.
  virtual std::unique_ptr<SkyModel> ForSun(Direction<World> to_sun,
                                           double sun_distance_au) const = 0;
};

/// SkySource::Create() and ForSun() at once, for a single moment.
Result<std::unique_ptr<SkyModel>> CreateSkyModel(SkyModelName name, const SkyConditions& conditions,
                                                 Direction<World> to_sun,
                                                 double sun_distance_au = 1.0);

}  // namespace pleinair::sky
