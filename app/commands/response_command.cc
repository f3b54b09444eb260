#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/options/model_options.h"
#include "app/options/option_use.h"
#include "app/terminal/pass_bar.h"
#include "base/atomic_file.h"
#include "devices/calibration/response_file.h"
#include "devices/recordings/recording.h"
#include "session/pipeline.h"
#include "session/recording_passes.h"
#include "session/scene_renderer.h"

namespace pleinair::app {
namespace {

constexpr const char* kResponseExamples =
    "Examples:\n"
    "  pleinair response my_recording -o camera.response\n"
    "  pleinair response my_recording --json\n"
    "  pleinair replay another_recording -o out --response camera.response\n"
    "Estimates the curve from light to pixel values from the marker's white and black and from\n"
    "phantoms of known color, in sun and in shade. sRGB holds unless the frames contradict it\n"
    "strongly: 10 times as likely under another curve. 'replay' does the same by itself.\n"
    "docs/guide/reference/calibrations.md explains what to film.";

// Larger logarithms of the evidence are printed as this one: e^20 is 5e8.
constexpr double kMostCertain = 20.0;

struct ResponseArguments {
  std::filesystem::path recording, output;
  std::optional<std::filesystem::path> scene, calibration;
  bool json = false;
};

Result<void> Write(const ResponseArguments& arguments, const session::SceneRenderer& renderer) {
  using Source = session::ResponseSummary::Source;
  const session::ResponseSummary found = renderer.light().response;
  const bool measured = found.source == Source::kMeasured;
  const bool by_film = found.source == Source::kFilm;
  if (!arguments.output.empty()) {
    PLEINAIR_RETURN_IF_ERROR(
        WriteFileAtomically(arguments.output, devices::CameraResponseText(renderer.response())));
  }
  if (arguments.json) {
    nlohmann::ordered_json summary{{"response", measured  ? "measured"
                                                : by_film ? "film"
                                                          : "srgb"},
                                   {"evidence_log", found.log_evidence},
                                   {"light_relative_error", found.log_error}};
    if (!arguments.output.empty()) summary["file"] = arguments.output.string();
    std::cout << summary.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    return {};
  }
  const double likelier = std::exp(std::min(found.log_evidence, kMostCertain));
  if (measured) {
    std::cout << fmt::format(
        "The camera does not encode light as sRGB. The curve found is {:.2g} times as likely, and "
        "gives the light within {:.0f} %.\n",
        likelier, 100 * found.log_error);
  } else {
    std::cout << fmt::format("{} holds. Another curve is {:.2g} times as likely.\n",
                             by_film ? "The curve of the film's tags" : "sRGB", likelier);
  }
  return {};
}

Result<void> RunResponse(const ResponseArguments& arguments) {
  const std::string name = arguments.recording.string();
  const auto open = [&] {
    return devices::OpenRecording(arguments.recording, {arguments.calibration, arguments.scene});
  };
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, open());
  if (!recording.scene) {
    return InputError(name, "has no scene",
                      "write one (docs/guide/reference/recordings.md) and give it with --scene");
  }
  scene::SceneDescription scene = *recording.scene;
  scene.camera.response.clear();
  if (scene.objects.empty() || scene.phantoms.empty()) {
    return InputError(name, scene.objects.empty() ? "has no virtual object" : "has no phantom",
                      "add it to the scene: the curve is seen on phantoms, and lighting needs an "
                      "object to light");
  }
  session::PipelineOptions options;
  options.light.film_response = devices::ResponseOf(recording.curve);
  PLEINAIR_ASSIGN_OR_RETURN(const auto pipeline,
                            session::Pipeline::Create(recording.camera, scene, options));
  const auto damage = recording.damage;
  {
    PassBar bar("Finding markers", name);
    PLEINAIR_RETURN_IF_ERROR(
        session::TrackRecording(*pipeline, std::move(recording), {}, {bar.Progress(), nullptr}));
  }
  for (const std::string& lost : *damage) std::cerr << "warning: " << lost << '\n';
  PLEINAIR_RETURN_IF_ERROR(session::EstimateResponse(*pipeline));
  if (!pipeline->renderer().light().response.IsShown()) {
    return InputError(name, "does not show the camera's response",
                      "film the marker large, in the sun, beside phantoms of known color, some in "
                      "shade (docs/guide/reference/calibrations.md)");
  }
  return Write(arguments, pipeline->renderer());
}

}  // namespace

void AddResponseCommand(CLI::App& app, CommandResult& result) {
  auto arguments = std::make_shared<ResponseArguments>();
  CLI::App* command = app.add_subcommand(
      "response", "Estimate the camera's curve from light to pixel values from a recording");
  command->footer(kResponseExamples);
  command->add_option("RECORDING", arguments->recording, "Recording with a scene")->required();
  command->add_option("--scene", arguments->scene, "Scene (.toml), if not in the recording");
  command->add_option("--calibration", arguments->calibration,
                      "Camera calibration, if not in the recording");
  command->add_option("-o,--output", arguments->output, "File to write, for --response");
  AddModelFileOptions(*command);
  command->add_flag("--json", arguments->json, "Print the result as one JSON object");
  RefuseEmptyValues(*command);
  command->callback([arguments, &result] { result.status = RunResponse(*arguments); });
}

}  // namespace pleinair::app
