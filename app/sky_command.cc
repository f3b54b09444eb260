#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/local_time.h"
#include "app/number_range.h"
#include "app/observer_options.h"
#include "app/progress_bar.h"
#include "app/result_file.h"
#include "app/sky_directions.h"
#include "app/sky_files.h"
#include "app/sky_moments.h"
#include "sky/sky_model.h"

namespace pleinair::app {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  pleinair sky --at 50.0875,14.4213 --time 2025-09-14T17:00:00Z\n"
    "      illuminances of sun and sky\n"
    "  pleinair sky --at 50.0875,14.4213 --time 2025-09-14T17:00:00Z -o evening.png\n"
    "      the dome as a fisheye: zenith in the centre, north up, east left\n"
    "  pleinair sky --sun 230,25 --turbidity 3 --disc -o sky.exr\n"
    "      an environment map for Blender (x east, y north) or three.js (x east, z south), with\n"
    "      the sun's disc, in cd/m2; .hdr is Radiance's\n"
    "  pleinair sky --sun 180,30 --model cie:12 --csv directions.csv -o sky.csv\n"
    "      for each row of azimuth_deg,elevation_deg six columns: luminance_cd_m2,x,y,r,g,b\n"
    "  pleinair sky --at 50.0875,14.4213 --day 2025-06-21 --utc-offset +02:00 -o day.mp4\n"
    "      a time-lapse, a frame every five minutes; without -o a table of illuminances\n"
    "Azimuth is clockwise from true north; the elevation of --sun is as seen, with refraction.\n"
    "Light: linear Rec.709, cd/m2 and lux.\n";

constexpr int kSmallest_px = 16;
constexpr int kLargest_px = 8192;
constexpr double kDaySeconds = 86'400.0;

struct AerosolOptions {
  std::optional<double> beta, alpha, scale_height_m, single_scattering_albedo, asymmetry;
};

struct Options {
  ObserverOptions observer;
  std::string time, until, day, utc_offset, sun;
  double step_s = 300.0;
  std::string model = "atmosphere";
  sky::SkyConditions conditions;
  std::optional<double> zenith_luminance_cd_m2, sky_illuminance_lx;
  AerosolOptions aerosol;
  std::string projection;
  std::optional<int> size_px;
  double centre_azimuth_deg = 90.0;
  bool disc = false, no_disc = false;
  std::optional<double> ev100;
  double scale = 1.0;
  double frames_per_second = 24.0;
  std::string csv;
  bool json = false;
  std::string output;
};

/// The aerosol of the turbidity, with what was given instead; nothing where nothing was.
std::optional<sky::Aerosol> ChosenAerosol(const Options& options) {
  const AerosolOptions& given = options.aerosol;
  if (!given.beta && !given.alpha && !given.scale_height_m && !given.single_scattering_albedo &&
      !given.asymmetry) {
    return std::nullopt;
  }
  sky::Aerosol aerosol;
  if (options.conditions.turbidity) {
    aerosol = sky::AerosolOfTurbidity(*options.conditions.turbidity);
  }
  aerosol.beta = given.beta.value_or(aerosol.beta);
  aerosol.alpha = given.alpha.value_or(aerosol.alpha);
  aerosol.scale_height_m = given.scale_height_m.value_or(aerosol.scale_height_m);
  aerosol.single_scattering_albedo =
      given.single_scattering_albedo.value_or(aerosol.single_scattering_albedo);
  aerosol.asymmetry = given.asymmetry.value_or(aerosol.asymmetry);
  return aerosol;
}

sky::SkyConditions ChosenConditions(const Options& options) {
  sky::SkyConditions conditions = options.conditions;
  conditions.aerosol = ChosenAerosol(options);
  if (options.zenith_luminance_cd_m2) {
    conditions.zenith_luminance = CandelaPerM2(*options.zenith_luminance_cd_m2);
  }
  if (options.sky_illuminance_lx) {
    conditions.sky_horizontal_illuminance = Lux(*options.sky_illuminance_lx);
  }
  return conditions;
}

/// One moment, or the many of a span.
Result<std::vector<SkyMoment>> ChosenMoments(const Options& options) {
  if (!options.sun.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(SkyMoment moment, ParseSunOption(options.sun));
    return std::vector<SkyMoment>{moment};
  }
  if (options.observer.at.empty() || (options.time.empty() && options.day.empty())) {
    return InputError("", "pleinair sky needs a place and a time, or a sun",
                      "give --at LAT,LON and --time T or --day DATE, or --sun AZ,EL; see pleinair "
                      "sky --help");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const sky::Observer observer, MakeObserver(options.observer));
  UtcTime from, until;
  if (!options.day.empty()) {
    if (options.utc_offset.empty()) {
      return InputError("--day", "whose clock is meant is not said",
                        "give --utc-offset too, for example --utc-offset +02:00");
    }
    PLEINAIR_ASSIGN_OR_RETURN(const UtcOffset offset,
                              ParseUtcOffset(options.utc_offset, "--utc-offset"));
    PLEINAIR_ASSIGN_OR_RETURN(from, ParseDay(options.day, offset, "--day"));
    until = from.PlusSeconds(kDaySeconds);
  } else {
    PLEINAIR_ASSIGN_OR_RETURN(from, ParseTimeOption("--time", options.time));
    until = from;
    if (!options.until.empty()) {
      PLEINAIR_ASSIGN_OR_RETURN(until, ParseTimeOption("--until", options.until));
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<UtcTime> times, Moments(from, until, options.step_s));
  std::vector<SkyMoment> moments;
  moments.reserve(times.size());
  for (const UtcTime time : times) {
    moments.push_back(MomentAt(observer, time, sky::SunModel::kPrecise));
  }
  return moments;
}

Result<SkyFileOptions> ChosenFile(const Options& options, bool many) {
  SkyFileOptions file;
  file.file = options.output;
  PLEINAIR_ASSIGN_OR_RETURN(file.kind, SkyFileKindOf(options.output));
  const bool video = file.kind == SkyFileKind::kMp4;
  if (many && !video) {
    return InputError(options.output, "is one picture for many moments",
                      "name a video (.mp4), or give one --time");
  }
  if (!many && video) {
    return InputError(options.output, "is a video of one moment",
                      "give --until or --day, or name a picture");
  }
  const bool light = file.kind == SkyFileKind::kExr || file.kind == SkyFileKind::kHdr;
  const std::string projection =
      !options.projection.empty() ? options.projection : (light ? "latlong" : "fisheye");
  const bool fisheye = projection == "fisheye";
  file.picture.projection = fisheye ? SkyProjection::kFisheye : SkyProjection::kLatLong;
  const int height_px = video ? 720 : 1024;
  file.picture.width_px = options.size_px.value_or(fisheye ? height_px : 2 * height_px);
  if (!fisheye && file.picture.width_px % 2 != 0) {
    return InputError("--size", "a latitude-longitude map is twice as wide as high",
                      "give an even number");
  }
  file.picture.centre_azimuth_deg = options.centre_azimuth_deg;
  file.picture.ground_albedo = options.conditions.ground_albedo;
  // On a screen the sun is a white spot; in light for a scene it is a choice.
  file.picture.disc = options.disc || (!light && !options.no_disc);
  if (options.ev100) file.exposure = ExposureOf(*options.ev100);
  file.scale = options.scale;
  file.frames_per_second = options.frames_per_second;
  return file;
}

nlohmann::json Describe(const SkyFileOptions& file, sky::SkyModelName name, std::size_t frames) {
  nlohmann::json object = {
      {"file", file.file},
      {"model", ToString(name)},
      {"projection", file.picture.projection == SkyProjection::kFisheye ? "fisheye" : "latlong"},
      {"width_px", file.picture.width_px},
      {"disc", file.picture.disc}};
  if (frames > 1) object["frames"] = frames;
  return object;
}

void Print(const nlohmann::json& object) {
  std::cout << object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

Result<void> RunVideo(const Options& options, const sky::SkySource& source, sky::SkyModelName name,
                      const std::vector<SkyMoment>& moments) {
  PLEINAIR_ASSIGN_OR_RETURN(const SkyFileOptions file, ChosenFile(options, true));
  PLEINAIR_RETURN_IF_ERROR(WriteSkyVideo(source, moments, file));
  if (options.json) Print(Describe(file, name, moments.size()));
  return {};
}

Result<void> RunSeries(const Options& options, const sky::SkySource& source,
                       const std::vector<SkyMoment>& moments) {
  PLEINAIR_ASSIGN_OR_RETURN(ResultFile output, ResultFile::Open(options.output));
  if (!options.json) output.stream() << kSkyLightColumns << '\n';
  ProgressBar bar("sky", static_cast<std::int64_t>(moments.size()), "moments");
  for (const SkyMoment& moment : moments) {
    const auto sky = source.ForSun(moment.ToSun(), moment.sun_distance_au);
    const SkyLight light = MeasureSky(*sky, moment);
    output.stream() << (options.json ? "{" + SkyLightJson(light) + "}\n" : SkyLightCsv(light));
    bar.Advance();
  }
  return output.Finish();
}

Result<void> RunMoment(const Options& options, const sky::SkySource& source, sky::SkyModelName name,
                       const SkyMoment& moment) {
  std::optional<SkyFileOptions> file;
  if (options.csv.empty()) {
    if (!options.output.empty()) {
      PLEINAIR_ASSIGN_OR_RETURN(file, ChosenFile(options, false));
    }
  } else if (SkyFileKindOf(options.output)) {
    return InputError(options.output, "is the name of a picture, but --csv gives a table",
                      "name a table (.csv), or leave --csv out");
  }
  const auto sky = source.ForSun(moment.ToSun(), moment.sun_distance_au);
  for (const std::string& note : sky->Notes()) std::cerr << "pleinair: " << note << '\n';
  if (!options.csv.empty()) {
    return WriteSkyDirections(*sky, options.conditions.ground_albedo, options.csv, options.output,
                              options.json);
  }
  const SkyLight light = MeasureSky(*sky, moment);
  if (file) PLEINAIR_RETURN_IF_ERROR(WriteSkyPicture(*sky, light, *file));
  if (!options.json) {
    if (!file) std::cout << SkyLightText(light);
    return {};
  }
  std::string json = fmt::format(R"({{"model":"{}",{})", ToString(name), SkyLightJson(light));
  if (!sky->Notes().empty()) json += ",\"notes\":" + nlohmann::json(sky->Notes()).dump();
  if (file) {
    nlohmann::json picture = Describe(*file, name, 1);
    picture.erase("model");
    if (file->kind == SkyFileKind::kPng) {
      const SkyExposure exposure = ExposureFor(*file, light);
      picture["gain_per_cd_m2"] = exposure.gain;
      picture["ev100"] = exposure.Ev100();
    } else {
      picture["value_per_cd_m2"] = file->scale;
    }
    json +=
        ",\"picture\":" + picture.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  std::cout << json << "}\n";
  return {};
}

Result<void> Run(const Options& options) {
  PLEINAIR_ASSIGN_OR_RETURN(const sky::SkyModelName name, sky::ParseSkyModelName(options.model));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<SkyMoment> moments, ChosenMoments(options));
  PLEINAIR_ASSIGN_OR_RETURN(const auto source,
                            sky::SkySource::Create(name, ChosenConditions(options)));
  const bool many = !options.until.empty() || !options.day.empty();
  if (!many) return RunMoment(options, *source, name, moments.front());
  const std::string ending =
      options.output.size() < 4 ? "" : options.output.substr(options.output.size() - 4);
  if (options.output.empty() || ending == ".csv") return RunSeries(options, *source, moments);
  if (moments.size() < 2) {
    return InputError(options.output, "is a video of one moment",
                      "give a smaller --step or a later --until");
  }
  return RunVideo(options, *source, name, moments);
}

}  // namespace

void AddSkyCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("sky", "The sky's light: illuminances, pictures, directions, a video");
  command->footer(kExamples);
  CLI::Option* at = AddObserverOptions(*command, options->observer);
  CLI::Option* time =
      command->add_option("--time,--from", options->time, "Moment, RFC 3339 with Z or an offset")
          ->type_name("T");
  CLI::Option* until = command
                           ->add_option("--until,--to", options->until,
                                        "Last moment of a table or video from --time on")
                           ->type_name("T")
                           ->needs(time);
  CLI::Option* day = command
                         ->add_option("--day", options->day,
                                      "A whole day instead, as 2025-06-21, of the clock at "
                                      "--utc-offset")
                         ->type_name("DATE")
                         ->excludes(time);
  CLI::Option* offset =
      command->add_option("--utc-offset", options->utc_offset, "Local time minus UTC, as +02:00")
          ->type_name("OFFSET")
          ->needs(day);
  CLI::Option* step = command->add_option("--step", options->step_s, "Seconds between moments")
                          ->type_name("S")
                          ->capture_default_str();
  CLI::Option* sun = command
                         ->add_option("--sun", options->sun,
                                      "The sun itself: azimuth,elevation in degrees, as seen")
                         ->type_name("AZ,EL");
  for (CLI::Option* other : {at, time, until, day, offset, step}) sun->excludes(other);
  command
      ->add_option("--model", options->model,
                   "atmosphere (physically based), perez (Preetham 1999), cie:1 to cie:15")
      ->capture_default_str();
  command
      ->add_option("--turbidity", options->conditions.turbidity,
                   "Haze: 2 very clear, 3 clear, 6 hazy; without it an ordinary clear day")
      ->type_name("T");
  command
      ->add_option("--albedo", options->conditions.ground_albedo,
                   "Diffuse reflectance of the land, 0 to 1")
      ->type_name("A")
      ->capture_default_str();
  command
      ->add_option("--cloud-cover,--clouds", options->conditions.cloud_cover,
                   "0 clear to 1 overcast; not with cie:N")
      ->type_name("C")
      ->capture_default_str();
  command
      ->add_option("--zenith-luminance", options->zenith_luminance_cd_m2,
                   "cd/m2, the scale of a cie:N sky")
      ->type_name("L");
  command
      ->add_option("--sky-illuminance", options->sky_illuminance_lx,
                   "Lux of the sky on level ground, the scale of a cie:N sky")
      ->type_name("E");
  const auto add_aerosol = [&](const char* name, std::optional<double>& value, const char* what) {
    command->add_option(name, value, what)->type_name("X")->group("Aerosol of the atmosphere");
  };
  add_aerosol("--aerosol-beta", options->aerosol.beta,
              "Angstrom's coefficient: optical depth at 1 micrometre");
  add_aerosol("--aerosol-alpha", options->aerosol.alpha, "Angstrom's exponent");
  add_aerosol("--aerosol-height", options->aerosol.scale_height_m, "Scale height in metres");
  add_aerosol("--aerosol-albedo", options->aerosol.single_scattering_albedo,
              "Single-scattering albedo");
  add_aerosol("--aerosol-asymmetry", options->aerosol.asymmetry, "Asymmetry g");
  command
      ->add_option("--projection", options->projection,
                   "fisheye or latlong; without it latlong for .exr and .hdr, else fisheye")
      ->check(CLI::IsMember({"fisheye", "latlong"}));
  command
      ->add_option("--size", options->size_px,
                   "Width in pixels; a fisheye is as high, a latlong half as high")
      ->type_name("N")
      ->check(CLI::Range(kSmallest_px, kLargest_px));
  command
      ->add_option("--centre-azimuth,--center-azimuth", options->centre_azimuth_deg,
                   "In the middle of a latlong; 90 for Blender and three.js")
      ->type_name("AZ")
      ->check(NumberRange(-360.0, 360.0))
      ->capture_default_str();
  CLI::Option* disc = command->add_flag(
      "--disc", options->disc, "Draw the sun's disc (PNG and video do without being asked)");
  command->add_flag("--no-disc", options->no_disc, "Leave it out")->excludes(disc);
  command
      ->add_option("--exposure", options->ev100,
                   "EV at ISO 100 of a PNG or video; without it as an eye adapts")
      ->type_name("EV")
      ->check(NumberRange(-20.0, 30.0));
  command->add_option("--scale", options->scale, "Value per cd/m2 of .exr and .hdr")
      ->type_name("K")
      ->check(NumberRange(1e-12, 1e12))
      ->capture_default_str();
  command->add_option("--fps", options->frames_per_second, "Frames a second of a video")
      ->type_name("N")
      ->check(NumberRange(1.0, 120.0))
      ->capture_default_str();
  command->add_option("--csv", options->csv, "Table of directions; - for standard input")
      ->type_name("FILE")
      ->excludes(until)
      ->excludes(day);
  command->add_flag("--json", options->json, "One JSON object a line");
  command
      ->add_option("-o,--output", options->output,
                   "Picture (.png, .exr, .hdr), video (.mp4) or table")
      ->type_name("FILE");
  command->callback([options, &result] { result.status = Run(*options); });
}

}  // namespace pleinair::app
