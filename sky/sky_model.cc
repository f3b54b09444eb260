#include "sky/sky_model.h"

#include <charconv>
#include <cmath>
#include <cstdio>

#include "sky/cie_sky.h"
#include "sky/sky_sources.h"

namespace pleinair::sky {
namespace {

constexpr std::string_view kCiePrefix = "cie:";

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// An error unless `value` lies within [low, high].
Result<void> CheckRange(const char* what, double value, double low, double high) {
  if (value >= low && value <= high) return {};
  return InputError({}, std::string(what) + " " + Number(value) + " is impossible",
                    "give a value from " + Number(low) + " to " + Number(high));
}

Result<void> CheckAerosol(const Aerosol& aerosol) {
  PLEINAIR_RETURN_IF_ERROR(CheckRange("an aerosol's beta of", aerosol.beta, 0.0, 2.0));
  PLEINAIR_RETURN_IF_ERROR(CheckRange("an aerosol's alpha of", aerosol.alpha, 0.0, 4.0));
  PLEINAIR_RETURN_IF_ERROR(
      CheckRange("an aerosol's scale height of", aerosol.scale_height_m, 300.0, 5000.0));
  PLEINAIR_RETURN_IF_ERROR(CheckRange("an aerosol's single-scattering albedo of",
                                      aerosol.single_scattering_albedo, 0.0, 1.0));
  return CheckRange("an aerosol's asymmetry of", aerosol.asymmetry, 0.0, 0.95);
}

Result<void> Check(SkyModelName name, const SkyConditions& conditions) {
  if (conditions.turbidity) {
    PLEINAIR_RETURN_IF_ERROR(
        CheckRange("turbidity", *conditions.turbidity, kMinTurbidity, kMaxTurbidity));
  }
  PLEINAIR_RETURN_IF_ERROR(CheckRange("ground albedo", conditions.ground_albedo, 0.0, 1.0));
  PLEINAIR_RETURN_IF_ERROR(CheckRange("cloud cover", conditions.cloud_cover, 0.0, 1.0));
  if (conditions.aerosol) {
    if (name.kind != SkyModelKind::kAtmosphere) {
      return InputError({}, ToString(name) + " knows turbidity only, no aerosol",
                        "give a turbidity, or use the model atmosphere");
    }
    PLEINAIR_RETURN_IF_ERROR(CheckAerosol(*conditions.aerosol));
  }
  const bool scaled = conditions.zenith_luminance || conditions.sky_horizontal_illuminance;
  if (name.kind != SkyModelKind::kCie) {
    if (!scaled) return {};
    return InputError({}, ToString(name) + " has its own scale",
                      "give a zenith luminance or an illuminance with cie:1 to cie:15 only");
  }
  if (conditions.cloud_cover != 0.0) {
    return InputError({}, "cloud cover has no meaning with " + ToString(name),
                      "choose the clouds by the type, or use another model");
  }
  if (conditions.zenith_luminance && conditions.sky_horizontal_illuminance) {
    return InputError({}, "zenith luminance and horizontal illuminance cannot both be given",
                      "give one of them");
  }
  if (conditions.zenith_luminance) {
    return CheckRange("a zenith luminance of", conditions.zenith_luminance->value(), 0.0, 1e9);
  }
  if (conditions.sky_horizontal_illuminance) {
    return CheckRange("a sky illuminance of", conditions.sky_horizontal_illuminance->value(), 0.0,
                      1e9);
  }
  return {};
}

}  // namespace

Result<SkyModelName> ParseSkyModelName(std::string_view name) {
  if (name == "atmosphere") return SkyModelName{SkyModelKind::kAtmosphere, 0};
  if (name == "perez") return SkyModelName{SkyModelKind::kPerez, 0};
  const std::string models = "use atmosphere, perez or cie:1 to cie:15";
  if (!name.starts_with(kCiePrefix)) {
    return InputError({}, "unknown sky model \"" + std::string(name) + "\"", models);
  }
  const std::string_view digits = name.substr(kCiePrefix.size());
  int type = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), type);
  if (error != std::errc{} || end != digits.data() + digits.size() || type < 1 ||
      type > CieSky::kTypes) {
    return InputError({}, "there is no CIE sky \"" + std::string(digits) + "\"", models);
  }
  return SkyModelName{SkyModelKind::kCie, type};
}

std::string ToString(SkyModelName name) {
  switch (name.kind) {
    case SkyModelKind::kAtmosphere:
      return "atmosphere";
    case SkyModelKind::kPerez:
      return "perez";
    case SkyModelKind::kCie:
      return std::string(kCiePrefix) + std::to_string(name.cie_type);
  }
  return {};
}

Result<std::shared_ptr<const SkySource>> SkySource::Create(SkyModelName name,
                                                           const SkyConditions& conditions) {
  PLEINAIR_RETURN_IF_ERROR(Check(name, conditions));
  std::shared_ptr<const SkySource> source;
  switch (name.kind) {
    case SkyModelKind::kPerez:
      source = internal::MakePerezSource(conditions);
      break;
    case SkyModelKind::kCie:
      source = internal::MakeCieSource(name.cie_type, conditions);
      break;
    case SkyModelKind::kAtmosphere:
      source = internal::MakeAtmosphereSource(conditions);
      break;
  }
  if (conditions.cloud_cover > 0.0) {
    source = internal::MakeCloudySource(std::move(source), conditions.cloud_cover);
  }
  return source;
}

Result<std::unique_ptr<SkyModel>> CreateSkyModel(SkyModelName name, const SkyConditions& conditions,
                                                 Direction<World> to_sun, double sun_distance_au) {
  PLEINAIR_ASSIGN_OR_RETURN(const auto source, SkySource::Create(name, conditions));
  return source->ForSun(to_sun, sun_distance_au);
}

}  // namespace pleinair::sky
