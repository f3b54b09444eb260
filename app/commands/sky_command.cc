#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/options/option_use.h"
#include "app/sky/layered_sky.h"
#include "app/sky/shadow_points.h"
#include "app/sky/sky_directions.h"
#include "app/sky/sky_files.h"
#include "app/sky/sky_options.h"
#include "app/terminal/progress_bar.h"
#include "files/result_file.h"
#include "sky/sky_model.h"

namespace pleinair::app {
namespace {

constexpr const char* kSkyExamples =
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
    "  pleinair sky --sun 180,40 --cloud-layer "
    "kind=cumulus,cover=0.4,wind_m_s=8,wind_from_deg=250\\\n"
    "               --seconds 60 -o clouds.png\n"
    "      a layer of clouds, a minute after it formed; with --shadow-at points.csv -o shadow.csv\n"
    "      the sun's light at east_m,north_m[,height_m][,seconds]\n"
    "Azimuth is clockwise from true north; the elevation of --sun is as seen, with refraction.\n"
    "Light: linear Rec.709, cd/m2 and lux.\n";

nlohmann::json DescribeSky(const SkyFileOptions& file, sky::SkyModelName name, std::size_t frames) {
  nlohmann::json object = {
      {"file", file.file},
      {"model", ToString(name)},
      {"projection", file.picture.projection == SkyProjection::kFisheye ? "fisheye" : "latlong"},
      {"width_px", file.picture.width_px},
      {"disc", file.picture.disc}};
  if (frames > 1) object["frames"] = frames;
  return object;
}

void PrintSky(const nlohmann::json& object) {
  std::cout << object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

Result<void> RunVideo(const SkyOptions& options, const LayeredSky& skies, sky::SkyModelName name,
                      const std::vector<SkyMoment>& moments) {
  PLEINAIR_ASSIGN_OR_RETURN(const SkyFileOptions file, ChosenFile(options));
  PLEINAIR_RETURN_IF_ERROR(
      WriteSkyVideo([&skies](const SkyMoment& moment) { return skies.At(moment); }, moments, file));
  if (options.json) PrintSky(DescribeSky(file, name, moments.size()));
  return {};
}

Result<void> RunSeries(const SkyOptions& options, const LayeredSky& skies,
                       const std::vector<SkyMoment>& moments) {
  PLEINAIR_ASSIGN_OR_RETURN(files::ResultFile output, files::ResultFile::Open(options.output));
  if (!options.json) output.stream() << kSkyLightColumns << '\n';
  ProgressBar bar("sky", static_cast<std::int64_t>(moments.size()), "moments");
  for (const SkyMoment& moment : moments) {
    const auto sky = skies.At(moment);
    const SkyLight light = MeasureSky(*sky, moment);
    output.stream() << (options.json ? "{" + SkyLightJson(light) + skies.Json(*sky, moment) + "}\n"
                                     : SkyLightCsv(light));
    bar.Advance();
  }
  return output.Finish();
}

Result<void> RunMoment(const SkyOptions& options, const LayeredSky& skies, sky::SkyModelName name,
                       const SkyMoment& moment) {
  std::optional<SkyFileOptions> file;
  const bool points = !options.clouds.shadow_at.empty();
  if (options.csv.empty() && !points) {
    if (!options.output.empty()) {
      PLEINAIR_ASSIGN_OR_RETURN(file, ChosenFile(options));
    }
  } else if (SkyFileKindOf(options.output)) {
    return InputError(options.output,
                      points ? "is the name of a picture, but --shadow-at gives a table"
                             : "is the name of a picture, but --csv gives a table",
                      points ? "name a table (.csv), or leave --shadow-at out"
                             : "name a table (.csv), or leave --csv out");
  }
  if (points) {
    return WriteCloudShadow(skies, moment, options.clouds.shadow_at, options.output, options.json);
  }
  const auto sky = skies.At(moment);
  for (const std::string& note : sky->Notes()) std::cerr << "pleinair: " << note << '\n';
  if (!options.csv.empty()) {
    return WriteSkyDirections(*sky, options.model.conditions.ground_albedo, options.csv,
                              options.output, options.json);
  }
  const SkyLight light = MeasureSky(*sky, moment);
  if (file) PLEINAIR_RETURN_IF_ERROR(WriteSkyPicture(*sky, light, *file));
  if (!options.json) {
    if (!file) std::cout << SkyLightText(light);
    return {};
  }
  std::string json = fmt::format(R"({{"model":"{}",{})", ToString(name), SkyLightJson(light));
  json += skies.Json(*sky, moment);
  if (!sky->Notes().empty()) json += ",\"notes\":" + nlohmann::json(sky->Notes()).dump();
  if (file) {
    nlohmann::json picture = DescribeSky(*file, name, 1);
    picture.erase("model");
    if (file->kind == SkyFileKind::kPng) {
      const SkyExposure exposure = ExposureFor(*file, light);
      picture["gain_per_cd_m2"] = exposure.exposure_scale;
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

Result<void> RunSky(const CLI::App& command, const SkyOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(const sky::SkyModelName name,
                            sky::ParseSkyModelName(options.model.name));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<SkyMoment> moments, ChosenMoments(options.span));
  PLEINAIR_RETURN_IF_ERROR(CheckUseOfSkyOptions(command, options, name));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<clouds::CloudLayer> layers,
                            ChosenClouds(options.clouds));
  PLEINAIR_ASSIGN_OR_RETURN(const auto source,
                            sky::SkySource::Create(name, ChosenConditions(options.model)));
  const LayeredSky skies(source, layers, options.model.conditions.ground_albedo,
                         options.clouds.seconds, moments.front().time);
  if (!options.Many()) return RunMoment(options, skies, name, moments.front());
  if (!options.IsPicture()) return RunSeries(options, skies, moments);
  if (moments.size() < 2) {
    return InputError(options.output, "is a video of one moment",
                      "give a smaller --step or a later --until");
  }
  return RunVideo(options, skies, name, moments);
}

}  // namespace

void AddSkyCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<SkyOptions>();
  CLI::App* command =
      app.add_subcommand("sky", "The sky's light: illuminances, pictures, directions, a video");
  command->footer(kSkyExamples);
  AddSkyOptions(*command, *options);
  RefuseEmptyValues(*command);
  command->callback([command, options, &result] { result.status = RunSky(*command, *options); });
}

}  // namespace pleinair::app
