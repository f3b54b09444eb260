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

/// Light of sun and sky at one time, in linear Rec.709 with absolute photometric scale: radiance in
/// cd/m², irradiance in lux, so that Luminance(rgb) is the photometric value. No channel is
/// negative or NaN at any sun elevation. Thread-safe.
class SkyModel {
 public:
  virtual ~SkyModel() = default;

  /// Sky radiance (without the sun's disc) from a direction of the upper hemisphere: unit vector,
  /// east, north, up. Zero below the horizon.
  virtual LinearRgb SkyRadiance(Direction<World> from) const = 0;

  /// Luminance (cd/m²) and CIE 1931 chromaticity in a direction. Unlike SkyRadiance() the
  /// chromaticity may lie outside Rec.709's gamut; the luminance is the same.
  virtual XyY At(Direction<World> from) const { return XyYFromRgb(SkyRadiance(from)); }

  /// The sun's illuminance on a surface facing it; zero when the disc is below the horizon.
  virtual LinearRgb SunNormalIrradiance() const = 0;

  /// The sky's horizontal illuminance.
  virtual LinearRgb SkyHorizontalIrradiance() const = 0;

  /// Direction to the apparent (refracted) sun.
  virtual Direction<World> ToSun() const = 0;

  /// Aerial perspective between the eye and a point, see sky/atmosphere/aerial_perspective.h.
  /// Models without an atmosphere (kPerez, kCie) give none: transmittance 1, inscattered 0.
  struct AirBetween {
    LinearRgb transmittance{1.0, 1.0, 1.0};
    LinearRgb inscattered;  ///< cd/m².
  };
  virtual AirBetween AirTo(Direction<World> /*towards*/, Metres /*distance*/) const { return {}; }

  /// Warnings for the user about inputs that were changed: "turbidity 1.5 is outside …".
  virtual std::vector<std::string> Notes() const { return {}; }
};

enum class SkyModelKind {
  kAtmosphere,  ///< Physically based, sky/atmosphere/atmosphere.h.
  kPerez,       ///< Preetham's form of Perez, sky/perez.h.
  kCie,         ///< One of the CIE standard general skies, sky/cie_sky.h.
};

/// A model as the user names it: "atmosphere", "perez" or "cie:1" to "cie:15".
struct SkyModelName {
  SkyModelKind kind = SkyModelKind::kAtmosphere;
  int cie_type = 0;  ///< 1…15 with kCie.
  bool operator==(const SkyModelName&) const = default;
};

/// Errors: an unknown model, a CIE type outside 1…15 (input).
Result<SkyModelName> ParseSkyModelName(std::string_view name);
std::string ToString(SkyModelName name);

inline constexpr double kMinTurbidity = 1.0;   ///< Air without any aerosol.
inline constexpr double kMaxTurbidity = 30.0;  ///< Thick haze, visibility 3 km.
/// An ordinary clear day. With it, the diffuse share of the global illuminance under kAtmosphere is
/// within 5 % of IES' clear-sky share for sun elevations of 10° to 70°
/// (tests/sky/atmosphere/atmosphere_test.cc).
inline constexpr double kDefaultTurbidity = 1.8;

/// State of air and clouds; independent of the sun.
struct SkyConditions {
  /// kMinTurbidity…kMaxTurbidity. A model with a narrower range clamps it and adds a note to
  /// Notes(). Default: kDefaultTurbidity, 2.5 for kPerez. No effect on kCie.
  std::optional<double> turbidity;
  /// Aerosol, in place of the one derived from `turbidity`; kAtmosphere only.
  std::optional<Aerosol> aerosol;
  /// Diffuse reflectance of the surrounding land, 0…1; kAtmosphere only.
  double ground_albedo = 0.15;
  /// 0 clear … 1 overcast (sky/cloud_cover.h). Must be 0 with kCie, whose type defines it.
  double cloud_cover = 0.0;
  /// Scale of a kCie sky; at most one of the two. Default: IES' illuminance for the type's
  /// cloudiness.
  std::optional<CandelaPerM2> zenith_luminance;
  std::optional<Lux> sky_horizontal_illuminance;
};

/// Makes skies of one model and one atmosphere for any sun position. Keeps the tables that do not
/// depend on the sun, so that updates for a moving sun are cheap. Thread-safe.
class SkySource {
 public:
  /// Errors (input): a value out of range, or not applicable to the model.
  static Result<std::shared_ptr<const SkySource>> Create(SkyModelName name,
                                                         const SkyConditions& conditions);
  virtual ~SkySource() = default;

  /// The sky at one time. `to_sun`: unit vector, east, north, up, to the apparent (refracted) sun,
  /// which may be below the horizon. `sun_distance_au`: its distance in astronomical units.
  virtual std::unique_ptr<SkyModel> ForSun(Direction<World> to_sun,
                                           double sun_distance_au) const = 0;
};

/// SkySource::Create() and ForSun() in one call, for a single time.
Result<std::unique_ptr<SkyModel>> CreateSkyModel(SkyModelName name, const SkyConditions& conditions,
                                                 Direction<World> to_sun,
                                                 double sun_distance_au = 1.0);

}  // namespace pleinair::sky
