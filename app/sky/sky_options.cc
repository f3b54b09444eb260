#include "app/sky/sky_options.h"

#include <utility>

#include <CLI/CLI.hpp>

#include "app/options/local_time.h"
#include "app/options/number_range.h"
#include "app/options/option_use.h"

namespace pleinair::app {
namespace {

constexpr int kMin_px = 16;
constexpr int kMax_px = 8192;
constexpr double kDaySeconds = 86'400.0;

/// The turbidity's aerosol with the given replacements; nothing if none were given.
std::optional<sky::Aerosol> ChosenAerosol(const SkyOptions::Aerosol& given,
                                          std::optional<double> turbidity) {
  if (!given.beta && !given.alpha && !given.scale_height_m && !given.single_scattering_albedo &&
      !given.asymmetry) {
    return std::nullopt;
  }
  sky::Aerosol aerosol;
  if (turbidity) aerosol = sky::AerosolOfTurbidity(*turbidity);
  aerosol.beta = given.beta.value_or(aerosol.beta);
  aerosol.alpha = given.alpha.value_or(aerosol.alpha);
  aerosol.scale_height_m = given.scale_height_m.value_or(aerosol.scale_height_m);
  aerosol.single_scattering_albedo =
      given.single_scattering_albedo.value_or(aerosol.single_scattering_albedo);
  aerosol.asymmetry = given.asymmetry.value_or(aerosol.asymmetry);
  return aerosol;
}

}  // namespace

bool SkyOptions::IsPicture() const {
  return csv.empty() && clouds.shadow_at.empty() && !output.empty() &&
         !(Many() && output.ends_with(".csv"));
}

sky::SkyConditions ChosenConditions(const SkyOptions::Model& given) {
  sky::SkyConditions conditions = given.conditions;
  conditions.aerosol = ChosenAerosol(given.aerosol, given.conditions.turbidity);
  if (given.zenith_luminance_cd_m2) {
    conditions.zenith_luminance = CandelaPerM2(*given.zenith_luminance_cd_m2);
  }
  if (given.sky_illuminance_lx) {
    conditions.sky_horizontal_illuminance = Lux(*given.sky_illuminance_lx);
  }
  return conditions;
}

Result<std::vector<clouds::CloudLayer>> ChosenClouds(const SkyOptions::Clouds& given) {
  constexpr const char* kOption = "--cloud-layer";
  if (given.layers.size() > clouds::kMaxCloudLayers) {
    return InputError(kOption, "is given " + std::to_string(given.layers.size()) + " times",
                      "give at most four layers");
  }
  std::vector<clouds::CloudLayer> layers;
  layers.reserve(given.layers.size());
  for (const std::string& text : given.layers) {
    Result<clouds::CloudLayer> layer = clouds::ParseCloudLayer(text);
    if (!layer) {
      layer.error().where = kOption;
      return tl::make_unexpected(std::move(layer).error());
    }
    layers.push_back(*layer);
  }
  return layers;
}

Result<std::vector<SkyMoment>> ChosenMoments(const SkyOptions::Span& span) {
  if (!span.sun.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(SkyMoment moment, ParseSunOption(span.sun));
    return std::vector<SkyMoment>{moment};
  }
  if (span.observer.at.empty() || (span.time.empty() && span.day.empty())) {
    return InputError("", "pleinair sky needs a place and a time, or a sun",
                      "give --at LAT,LON and --time T or --day DATE, or --sun AZ,EL; see pleinair "
                      "sky --help");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const sky::Observer observer, MakeObserver(span.observer));
  UtcTime from, until;
  if (!span.day.empty()) {
    std::optional<UtcOffset> offset;
    if (!span.utc_offset.empty()) {
      PLEINAIR_ASSIGN_OR_RETURN(offset, ParseUtcOffset(span.utc_offset, "--utc-offset"));
    }
    PLEINAIR_ASSIGN_OR_RETURN(from, ParseDay(span.day, offset, "--day"));
    until = from.PlusSeconds(kDaySeconds);
  } else {
    PLEINAIR_ASSIGN_OR_RETURN(from, ParseTimeOption("--time", span.time));
    until = from;
    if (!span.until.empty()) {
      PLEINAIR_ASSIGN_OR_RETURN(until, ParseTimeOption("--until", span.until));
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<UtcTime> times, Moments(from, until, span.step_s));
  std::vector<SkyMoment> moments;
  moments.reserve(times.size());
  for (const UtcTime time : times) {
    moments.push_back(MomentAt(observer, time, sky::SunModel::kPrecise));
  }
  return moments;
}

Result<SkyFileOptions> ChosenFile(const SkyOptions& options) {
  SkyFileOptions file;
  file.file = options.output;
  PLEINAIR_ASSIGN_OR_RETURN(file.kind, SkyFileKindOf(options.output));
  const bool video = file.kind == SkyFileKind::kMp4;
  if (options.Many() && !video) {
    return InputError(options.output, "is one picture for many moments",
                      "name a video (.mp4), or give one --time");
  }
  if (!options.Many() && video) {
    return InputError(options.output, "is a video of one moment",
                      "give --until or --day, or name a picture");
  }
  const bool light = file.kind == SkyFileKind::kExr || file.kind == SkyFileKind::kHdr;
  const std::string projection = !options.picture.projection.empty()
                                     ? options.picture.projection
                                     : (light ? "latlong" : "fisheye");
  const bool fisheye = projection == "fisheye";
  file.picture.projection = fisheye ? SkyProjection::kFisheye : SkyProjection::kLatLong;
  const int height_px = video ? 720 : 1024;
  file.picture.width_px = options.picture.size_px.value_or(fisheye ? height_px : 2 * height_px);
  if (!fisheye && file.picture.width_px % 2 != 0) {
    return InputError("--size", "a latitude-longitude map is twice as wide as high",
                      "give an even number");
  }
  file.picture.centre_azimuth_deg = options.picture.centre_azimuth_deg;
  file.picture.ground_albedo = options.model.conditions.ground_albedo;
  // On a screen the sun is a white spot. In a radiance map it is optional.
  file.picture.disc = options.picture.disc || (!light && !options.picture.no_disc);
  if (options.picture.ev100) file.exposure = ExposureOf(*options.picture.ev100);
  file.scale = options.picture.scale;
  file.frames_per_second = options.picture.frames_per_second;
  return file;
}

Result<void> CheckUseOfSkyOptions(const CLI::App& command, const SkyOptions& options,
                                  sky::SkyModelName name) {
  std::optional<SkyFileOptions> file;
  if (options.IsPicture()) {
    PLEINAIR_ASSIGN_OR_RETURN(file, ChosenFile(options));
  }
  const bool video = file && file->kind == SkyFileKind::kMp4;
  const bool screen = video || (file && file->kind == SkyFileKind::kPng);
  const bool map = file && file->picture.projection == SkyProjection::kLatLong;
  const bool place = options.span.sun.empty();
  const bool cie = name.kind == sky::SkyModelKind::kCie;
  // The ground affects only the sky of the atmosphere model, but every map and table shows it.
  const bool ground = name.kind == sky::SkyModelKind::kAtmosphere || map || !options.csv.empty() ||
                      !options.clouds.layers.empty();
  const bool layers = !options.clouds.layers.empty();
  const std::string picture = "a picture or video, with -o";
  return RefuseUnusedOptions(
      command,
      {{"--height", place, "a place, with --at"},
       {"--pressure", place, "a place, with --at"},
       {"--temperature", place, "a place, with --at"},
       {"--dut1", place, "a place, with --at"},
       {"--step", options.Many(), "a span or a day, with --until or --day"},
       {"--turbidity", !cie, "the models atmosphere and perez"},
       {"--cloud-cover", !cie,
        "the models atmosphere and perez; cie:N says its clouds by its type"},
       {"--cloud-layer", !cie, "the models atmosphere and perez"},
       {"--seconds", layers, "layers of clouds, with --cloud-layer"},
       {"--shadow-at", layers, "layers of clouds, with --cloud-layer"},
       {"--albedo", ground, "the model atmosphere, and to maps and tables, which show the land"},
       {"--projection", file.has_value(), picture},
       {"--size", file.has_value(), picture},
       {"--disc", file.has_value(), picture},
       {"--no-disc", file.has_value(), picture},
       {"--centre-azimuth", map, "a latitude-longitude map"},
       {"--exposure", screen, "a PNG or video"},
       {"--scale", file && !screen, "an .exr or .hdr"},
       {"--fps", video, "a video"}});
}

void AddSkyOptions(CLI::App& command, SkyOptions& options) {
  CLI::Option* at = AddObserverOptions(command, options.span.observer);
  CLI::Option* time = command
                          .add_option("--time,--from", options.span.time,
                                      "Moment, RFC 3339 with Z, an offset or its [zone]")
                          ->type_name("T");
  CLI::Option* until = command
                           .add_option("--until,--to", options.span.until,
                                       "Last moment of a table or video from --time on")
                           ->type_name("T")
                           ->needs(time);
  CLI::Option* day = command
                         .add_option("--day", options.span.day,
                                     "A whole day instead, as 2025-06-21, of the clock at "
                                     "--utc-offset")
                         ->type_name("DATE")
                         ->excludes(time);
  CLI::Option* offset =
      command
          .add_option("--utc-offset", options.span.utc_offset, "Local time minus UTC, as +02:00")
          ->type_name("OFFSET")
          ->needs(day);
  CLI::Option* step = command.add_option("--step", options.span.step_s, "Seconds between moments")
                          ->type_name("S")
                          ->capture_default_str();
  CLI::Option* sun = command
                         .add_option("--sun", options.span.sun,
                                     "The sun itself: azimuth,elevation in degrees, as seen")
                         ->type_name("AZ,EL");
  for (CLI::Option* other : {at, time, until, day, offset, step}) sun->excludes(other);
  command
      .add_option("--model", options.model.name,
                  "atmosphere (physically based), perez (Preetham 1999), cie:1 to cie:15")
      ->capture_default_str();
  command
      .add_option("--turbidity", options.model.conditions.turbidity,
                  "Haze: 2 very clear, 3 clear, 6 hazy; without it an ordinary clear day")
      ->type_name("T");
  command
      .add_option("--albedo", options.model.conditions.ground_albedo,
                  "Diffuse reflectance of the land, 0 to 1")
      ->type_name("A")
      ->capture_default_str();
  CLI::Option* cover =
      command
          .add_option("--cloud-cover,--clouds", options.model.conditions.cloud_cover,
                      "0 clear to 1 overcast; not with cie:N")
          ->type_name("C")
          ->capture_default_str();
  command
      .add_option("--cloud-layer", options.clouds.layers,
                  "A layer as kind=cumulus,cover=0.4,...; up to four times")
      ->type_name("KEY=VALUE,...")
      ->allow_extra_args(false)
      ->excludes(cover);
  command
      .add_option("--seconds", options.clouds.seconds,
                  "Seconds after the stated time by which the wind has moved the layers")
      ->type_name("S")
      ->check(NumberRange(-1e7, 1e7))
      ->capture_default_str();
  CLI::Option* shadow_at =
      command
          .add_option("--shadow-at", options.clouds.shadow_at,
                      "Table of points for the sun's light there; - for standard input")
          ->type_name("FILE")
          ->excludes(until)
          ->excludes(day);
  command
      .add_option("--zenith-luminance", options.model.zenith_luminance_cd_m2,
                  "cd/m2, the scale of a cie:N sky")
      ->type_name("L");
  command
      .add_option("--sky-illuminance", options.model.sky_illuminance_lx,
                  "Lux of the sky on level ground, the scale of a cie:N sky")
      ->type_name("E");
  const auto add_aerosol = [&](const char* name, std::optional<double>& value, const char* what) {
    command.add_option(name, value, what)->type_name("X")->group("Aerosol of the atmosphere");
  };
  add_aerosol("--aerosol-beta", options.model.aerosol.beta,
              "Angstrom's coefficient: optical depth at 1 micrometre");
  add_aerosol("--aerosol-alpha", options.model.aerosol.alpha, "Angstrom's exponent");
  add_aerosol("--aerosol-height", options.model.aerosol.scale_height_m, "Scale height in metres");
  add_aerosol("--aerosol-albedo", options.model.aerosol.single_scattering_albedo,
              "Single-scattering albedo");
  add_aerosol("--aerosol-asymmetry", options.model.aerosol.asymmetry, "Asymmetry g");
  command
      .add_option("--projection", options.picture.projection,
                  "fisheye or latlong; without it latlong for .exr and .hdr, else fisheye")
      ->check(CLI::IsMember({"fisheye", "latlong"}));
  command
      .add_option("--size", options.picture.size_px,
                  "Width in pixels; a fisheye is as high, a latlong half as high")
      ->type_name("N")
      ->check(CLI::Range(kMin_px, kMax_px));
  command
      .add_option("--centre-azimuth,--center-azimuth", options.picture.centre_azimuth_deg,
                  "In the middle of a latlong; 90 for Blender and three.js")
      ->type_name("AZ")
      ->check(NumberRange(-360.0, 360.0))
      ->capture_default_str();
  CLI::Option* disc = command.add_flag("--disc", options.picture.disc,
                                       "Draw the sun's disc (the default for PNG and video)");
  command.add_flag("--no-disc", options.picture.no_disc, "Do not draw the sun's disc")
      ->excludes(disc);
  command
      .add_option("--exposure", options.picture.ev100,
                  "EV at ISO 100 of a PNG or video; without it as an eye adapts")
      ->type_name("EV")
      ->check(NumberRange(-20.0, 30.0));
  command.add_option("--scale", options.picture.scale, "Value per cd/m2 of .exr and .hdr")
      ->type_name("K")
      ->check(NumberRange(1e-12, 1e12))
      ->capture_default_str();
  command.add_option("--fps", options.picture.frames_per_second, "Frames a second of a video")
      ->type_name("N")
      ->check(NumberRange(1.0, 120.0))
      ->capture_default_str();
  command.add_option("--csv", options.csv, "Table of directions; - for standard input")
      ->type_name("FILE")
      ->excludes(shadow_at)
      ->excludes(until)
      ->excludes(day);
  command.add_flag("--json", options.json, "One JSON object a line");
  command
      .add_option("-o,--output", options.output,
                  "Picture (.png, .exr, .hdr), video (.mp4) or table")
      ->type_name("FILE");
}

}  // namespace pleinair::app
