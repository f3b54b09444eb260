#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/clouds/clouds_text.h"
#include "app/clouds/recorded_light.h"
#include "app/commands/command.h"
#include "app/options/option_use.h"
#include "base/atomic_file.h"
#include "files/output_rule.h"
#include "sky/clouds/film/film_layer.h"

namespace pleinair::app {
namespace {

constexpr const char* kCloudsExamples =
    "Examples:\n"
    "  pleinair clouds out/site >> scene.toml\n"
    "      the clouds of a replay's light.csv as a [[cloud_layer]] that passes in step\n"
    "  pleinair clouds recordings/site --kind stratocumulus --wind-m-s 9 --wind-from-deg 250\n"
    "      follows the light of a recording first\n"
    "  pleinair clouds out/site --json --csv course.csv\n"
    "One place shows cell over wind, neither of them, and no direction: what is not stated is\n"
    "assumed, and the comments say so. Without clouds the answer is 'no clouds found', nothing is\n"
    "written, and the exit code is 0. docs/guide/clouds.md explains the numbers.";

struct CloudsArguments {
  RecordedLightRequest request;
  std::string kind;
  std::optional<double> wind_m_s, wind_from_deg;
  std::string output, csv;
  bool json = false;
};

Result<clouds::FilmLayerFacts> FactsOf(const CloudsArguments& arguments) {
  clouds::FilmLayerFacts facts;
  if (!arguments.kind.empty()) {
    auto kind = clouds::ParseCloudKind(arguments.kind);
    if (kind && *kind == clouds::CloudKind::kSlab) {
      return InputError("--kind", "a slab never changes", "choose another kind, or leave it out");
    }
    if (!kind) {
      Error error = std::move(kind).error();
      error.where = "--kind";
      return tl::make_unexpected(std::move(error));
    }
    facts.kind = *kind;
  }
  facts.wind_m_s = arguments.wind_m_s;
  facts.wind_from_deg = arguments.wind_from_deg;
  return facts;
}

Result<void> RunClouds(const CloudsArguments& arguments) {
  PLEINAIR_ASSIGN_OR_RETURN(const clouds::FilmLayerFacts facts, FactsOf(arguments));
  const RecordedLightRequest& request = arguments.request;
  const std::vector<std::string> inputs{request.recording, request.scene, request.calibration};
  if (!arguments.csv.empty()) {
    PLEINAIR_RETURN_IF_ERROR(files::CheckNamedOutput("--csv", arguments.csv, inputs));
  }
  if (!arguments.output.empty()) {
    PLEINAIR_RETURN_IF_ERROR(files::CheckNamedOutput("-o", arguments.output, inputs));
  }
  PLEINAIR_ASSIGN_OR_RETURN(const RecordedLight light, ReadRecordedLight(request));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<clouds::FilmLight> frames,
                            FramesOf(light, request.recording));
  PLEINAIR_ASSIGN_OR_RETURN(const clouds::FilmSky sky, ClearSkyOver(light, request.recording));
  auto course = clouds::MakeFilmCourse(frames, clouds::ClearSunOverSky(*sky.clear));
  if (!course) {
    Error error = std::move(course).error();
    error.where = request.recording;
    return tl::make_unexpected(std::move(error));
  }
  const clouds::FilmLayer fitted = clouds::FitFilmLayer(*course, facts, sky);
  const bool has_layer = fitted.outcome != clouds::FilmLayer::Outcome::kNoClouds;
  const std::string toml = FilmLayerToml(fitted, facts, request.recording);
  if (!arguments.csv.empty()) {
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(arguments.csv, FilmCourseCsv(*course, fitted)));
  }
  if (!arguments.output.empty() && has_layer) {
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(arguments.output, toml));
  }
  if (arguments.json) {
    std::cout << FilmLayerJson(fitted, facts, *course);
  } else if (arguments.output.empty()) {
    std::cout << toml;
  }
  if (!has_layer) std::cerr << "no clouds found: the sun is clear in all frames\n";
  constexpr double kWellKnown = 0.1;
  if (fitted.errors.light > kWellKnown) {
    std::cerr << "pleinair: the layer gives the film's light within "
              << std::lround(100.0 * fitted.errors.light)
              << " % only; another --kind or --wind-m-s may give it better\n";
  }
  return {};
}

}  // namespace

void AddCloudsCommand(CLI::App& app, CommandResult& result) {
  CLI::App* command = app.add_subcommand(
      "clouds", "Fit a layer of clouds to the light of a recording, for its scene");
  command->footer(kCloudsExamples);
  auto arguments = std::make_shared<CloudsArguments>();
  command
      ->add_option("RECORDING", arguments->request.recording,
                   "Folder of a replay with light.csv, or a recording")
      ->required();
  command->add_option("--calibration", arguments->request.calibration,
                      "Calibration of the lens instead of the recording's own");
  command->add_option("--scene", arguments->request.scene, "Scene instead of the recording's own");
  command->add_option("--kind", arguments->kind,
                      "cumulus, stratocumulus, stratus, altocumulus or cirrus; else by the light");
  command->add_option("--wind-m-s", arguments->wind_m_s, "Speed of the clouds")
      ->check(CLI::Range(0.1, 100.0));
  command
      ->add_option("--wind-from-deg", arguments->wind_from_deg,
                   "Azimuth that the clouds come from, from true north")
      ->check(CLI::Range(-360.0, 360.0));
  command->add_option("-o,--output", arguments->output, "Write the layer to this file")
      ->type_name("OUT.toml");
  command
      ->add_option("--csv", arguments->csv,
                   "Also write the light of the film and of the layer to this file")
      ->type_name("OUT.csv");
  command->add_flag("--json", arguments->json, "One JSON object");
  RefuseEmptyValues(*command);
  command->callback([arguments, &result] { result.status = RunClouds(*arguments); });
}

}  // namespace pleinair::app
