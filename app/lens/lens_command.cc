#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/command.h"
#include "app/lens/lens_text.h"
#include "app/options/option_use.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/interrupt_deadline.h"
#include "base/atomic_file.h"
#include "devices/recordings/recording.h"
#include "files/output_rule.h"
#include "session/lens_measurement.h"
#include "session/pipeline.h"
#include "session/recording_passes.h"

namespace pleinair::app {
namespace {

constexpr const char* kLensExamples =
    "Examples:\n"
    "  pleinair lens site\n"
    "      focus, aperture and exposure, with errors, by the blur of the marker's edges\n"
    "  pleinair lens walk.mp4 --calibration phone.yaml --scene scene.toml --json\n"
    "  pleinair lens site --csv blur.csv\n"
    "      every reading: frame,timestamp_s,side,distance_m,blur_px\n"
    "The marker has to be seen at distances that differ, best by a factor of two, and in motion\n"
    "for the exposure. Where the frames do not show it, the answer is 'not measured', with the\n"
    "reason; the exit code is 0.\n"
    "JSON: measured, reason, focus_m (null: infinity), focus_dioptres, focus_dioptres_error,\n"
    "aperture_mm, aperture_relative_error, in_focus_blur_px, exposure_ms, exposure_error_ms,\n"
    "exposure_reason, readings, nearest_m, farthest_m, metadata. docs/guide/lens.md explains "
    "them.";

struct LensArguments {
  std::string recording, scene, calibration, csv;
  bool json = false;
};

Result<void> RunLens(const LensArguments& arguments) {
  if (!arguments.csv.empty()) {
    const std::vector<std::string> inputs{arguments.recording, arguments.scene,
                                          arguments.calibration};
    PLEINAIR_RETURN_IF_ERROR(files::CheckNamedOutput("--csv", arguments.csv, inputs));
  }
  devices::RecordingOptions opening;
  if (!arguments.scene.empty()) opening.scene = arguments.scene;
  if (!arguments.calibration.empty()) opening.calibration = arguments.calibration;
  const InterruptGuard guard;
  const InterruptDeadline deadline(
      arguments.recording, [] {}, "nothing was measured");
  const session::PassMonitor monitor{[&](std::int64_t, std::optional<std::int64_t>) {
                                       return CheckInterrupt(arguments.recording);
                                     },
                                     nullptr};
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording,
                            devices::OpenRecording(arguments.recording, opening));
  if (!recording.scene) {
    return InputError(arguments.recording, "has no scene, which gives the marker's size",
                      "write one (docs/guide/reference/recordings.md) and give it with --scene");
  }
  const scene::SceneDescription scene = *recording.scene;
  session::PipelineOptions options;
  options.light.film_response = devices::ResponseOf(recording.curve);
  PLEINAIR_ASSIGN_OR_RETURN(const auto pipeline,
                            session::Pipeline::Create(recording.camera, scene, options));
  PLEINAIR_RETURN_IF_ERROR(session::TrackRecording(*pipeline, std::move(recording), {}, monitor));
  PLEINAIR_RETURN_IF_ERROR(session::EstimateResponse(*pipeline));
  PLEINAIR_ASSIGN_OR_RETURN(recording, devices::OpenRecording(arguments.recording, opening));
  PLEINAIR_ASSIGN_OR_RETURN(const session::MeasuredLens measured,
                            session::MeasureLens(*pipeline, {}, std::move(recording), monitor));
  if (!arguments.csv.empty()) {
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(arguments.csv, ReadingsCsv(measured.readings)));
  }
  const auto& metadata = scene.camera.recorded_lens;
  std::cout << (arguments.json ? LensJsonText(measured, metadata) : LensText(measured, metadata));
  return {};
}

}  // namespace

void AddLensCommand(CLI::App& app, CommandResult& result) {
  CLI::App* command = app.add_subcommand(
      "lens", "Measure focus, aperture and exposure of a recording on its marker");
  command->footer(kLensExamples);
  auto arguments = std::make_shared<LensArguments>();
  command->add_option("RECORDING", arguments->recording, "Folder of a recording, or a film")
      ->required();
  command->add_option("--calibration", arguments->calibration,
                      "Calibration of the lens instead of the recording's own");
  command->add_option("--scene", arguments->scene, "Scene instead of the recording's own");
  command->add_option("--csv", arguments->csv, "Also write every reading to this file")
      ->type_name("OUT");
  command->add_flag("--json", arguments->json, "One JSON object");
  RefuseEmptyValues(*command);
  command->callback([arguments, &result] { result.status = RunLens(*arguments); });
}

}  // namespace pleinair::app
