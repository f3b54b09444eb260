#include "app/replay/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

#include "app/options/light_options.h"
#include "app/output/resumption.h"
#include "app/output/trajectory_export.h"
#include "app/replay/compose_frames.h"
#include "app/replay/draw_day.h"
#include "app/replay/estimate_light.h"
#include "app/replay/film_calibration.h"
#include "app/replay/find_markers.h"
#include "app/replay/given_trajectory.h"
#include "app/replay/placement_warnings.h"
#include "app/replay/replay_state.h"
#include "app/replay/replay_warnings.h"
#include "app/replay/report/report_html.h"
#include "app/replay/report/report_json.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/interrupt_deadline.h"
#include "base/atomic_file.h"
#include "base/scaled_camera.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

void Describe(const devices::Recording& recording, const ReplayState& state, ReplayReport* report) {
  const scene::SceneDescription& scene = state.scene();
  report->call.recording = state.options.recording.string();
  report->call.command = state.options.command;
  report->call.version = PLEINAIR_VERSION;
  report->call.scene_file = scene.file.string();
  report->scene.place_time = scene.place_time;
  report->scene.cloudiness = scene.cloudiness;
  report->scene.virtual_objects = scene.objects.size();
  report->scene.phantoms = scene.phantoms.size();
  report->film.frame_rate_hz = recording.frame_rate_hz;
  report->film.antialiasing = state.options.composer.antialiasing;
  report->film.samples = state.renderer().samples();
  report->film.curve = recording.curve;
  report->film.width = state.pipeline->output_camera().width;
  report->film.height = state.pipeline->output_camera().height;
}

/// The trajectory that is composed along; nothing without one.
Result<std::optional<session::TrajectoryRequest>> TrajectoryOf(
    const ReplayOptions& options, const scene::SceneDescription& scene) {
  if (!options.trajectory.file.empty()) return ReadGivenTrajectory(options.trajectory);
  if (scene.trajectory) return ReadGivenTrajectory(*scene.trajectory);
  return std::nullopt;
}

/// What is read before the first frame.
struct PreparedReplay {
  devices::Recording recording;
  std::optional<session::TrajectoryRequest> trajectory;
};

/// The encoder refuses rates beyond these, some only at a later frame and without a reason. The
/// lowest is a frame a day. A rate of zero is unknown.
Result<void> CheckVideoRate(const ReplayOptions& options, double rate_hz) {
  constexpr double kMin_hz = 1e-5, kMax_hz = 1e5;
  if (rate_hz <= 0.0 || (rate_hz >= kMin_hz && rate_hz <= kMax_hz)) return {};
  return InputError(options.recording.string(),
                    fmt::format("has {:g} frames a second, which no video can have", rate_hz),
                    "correct its frame_rate_hz or its time stamps, or use --no-video --frames");
}

/// Opens the recording and loads its scene and its trajectory. Errors in the request appear before
/// the long detection pass.
Result<PreparedReplay> Prepare(ReplayState& state) {
  const ReplayOptions& options = state.options;
  PLEINAIR_ASSIGN_OR_RETURN(devices::Recording recording, state.OpenRecording());
  if (!recording.scene) {
    return InputError(options.recording.string(), "has no scene",
                      "write one (docs/guide/reference/recordings.md) and give it with --scene");
  }
  if (recording.is_photo) {
    state.write.frames = true;
    state.write.video = false;
  }
  if (state.write.video) {
    PLEINAIR_RETURN_IF_ERROR(CheckVideoRate(options, recording.frame_rate_hz));
  }
  if (options.time_lapse) {
    PLEINAIR_ASSIGN_OR_RETURN(state.day_moments,
                              MomentsOf(*options.time_lapse, recording.scene->place_time));
  }
  PLEINAIR_ASSIGN_OR_RETURN(auto trajectory, TrajectoryOf(options, *recording.scene));
  PLEINAIR_RETURN_IF_ERROR(CheckFrameOfDay(options, *recording.frames));
  const CameraModel& camera = recording.camera;
  PLEINAIR_RETURN_IF_ERROR(CheckExports(
      options.write.exports,
      ScaleCamera(camera, options.size.value_or(ImageSize{camera.width, camera.height}))));
  PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(options.recording.string()));
  session::LightOptions light = options.light;
  light.film_response = devices::ResponseOf(recording.curve);
  PLEINAIR_ASSIGN_OR_RETURN(
      state.pipeline,
      session::Pipeline::Create(
          camera, *recording.scene,
          {.composer = options.composer, .light = std::move(light), .image_size = options.size}));
  PLEINAIR_ASSIGN_OR_RETURN(state.ink, DrawMaps(*recording.scene, state.pipeline.get()));
  if (state.ink) state.report.warnings = state.ink->warnings();
  Describe(recording, state, &state.report);
  if (!recording.camera_note.empty()) state.report.warnings.push_back(recording.camera_note);
  return PreparedReplay{std::move(recording), std::move(trajectory)};
}

bool AssumesGround(const scene::SceneDescription& scene) {
  return std::any_of(scene.phantoms.begin(), scene.phantoms.end(), [](const auto& phantom) {
    return phantom.surface && phantom.surface->is_assumed;
  });
}

/// The files on which a replay depends, without the single frames of a recording and textures.
std::vector<fs::path> InputsOf(const devices::Recording& recording, const ReplayOptions& options,
                               const fs::path& staging) {
  std::vector<fs::path> files{options.recording};
  for (const char* name : {"recording.json", "scene.json", "scene.toml"}) {
    files.push_back(options.recording / name);
  }
  if (options.scene) files.push_back(*options.scene);
  // A calibration from the film itself is staged, and new each time.
  if (options.calibration && options.calibration->parent_path() != staging) {
    files.push_back(*options.calibration);
  }
  for (const auto* trajectory :
       {&options.trajectory,
        recording.scene->trajectory ? &*recording.scene->trajectory : nullptr}) {
    if (trajectory == nullptr) continue;
    for (const fs::path& file : {trajectory->file, trajectory->points, trajectory->extrinsics}) {
      if (!file.empty()) files.push_back(file);
    }
  }
  if (recording.sound) files.push_back(recording.sound->film);
  const std::string& response = recording.scene->camera.response;
  if (!response.empty()) files.emplace_back(response);
  for (const scene::DrapeDescription& drape : recording.scene->drapes) {
    files.push_back(drape.source.file);
  }
  for (const auto* models : {&recording.scene->phantoms, &recording.scene->objects}) {
    for (const scene::ModelReference& model : *models) {
      if (model.file.empty()) continue;
      files.push_back(model.file);
      files.push_back(fs::path(model.file).replace_extension(".mtl"));
    }
  }
  return files;
}

/// Collects the warnings known before compositing.
void Warn(ReplayState& state) {
  std::vector<std::string>& warnings = state.report.warnings;
  const auto add = [&](std::vector<std::string> sentences) {
    std::move(sentences.begin(), sentences.end(), std::back_inserter(warnings));
  };
  add(MarkerWarnings(state.report, state.pipeline->tracks(), state.scene()));
  add(state.frame_warnings.Sentences());
  if (state.read.lost_frames > 0) {
    warnings.push_back(
        fmt::format("{} frames were lost when this was recorded.", state.read.lost_frames));
  }
  add(ModelWarnings(state.renderer().placed()));
  add(PlacementWarnings(state.renderer().placed(), state.scene(),
                        {state.pipeline->output_camera(), state.report.path},
                        state.renderer().phantom_rays()));
  add(DrawingWarnings(state.renderer().samples()));
  add(CloudWarnings(state.scene()));
  if (!state.scene().DrawsAnything()) {
    warnings.push_back(NoObjectWarning(state.options.scene.has_value()));
  } else if (AssumesGround(state.scene())) {
    warnings.emplace_back(
        "The scene has no phantom: level ground in the marker's plane is assumed. Describe what is "
        "there ([ground], [[box]], [[wall]]), or write ground = false.");
  } else if (state.scene().phantoms.empty()) {
    warnings.emplace_back("The scene has no phantom: the objects cast no shadow on real surfaces.");
  }
}

Result<void> WriteReports(ReplayState& state) {
  ReplayReport& report = state.report;
  if (state.renderer().FailedToKeepLight()) {
    report.warnings.push_back(CouldNotKeepLight(state.options.light.cache));
  }
  if (report.light) {
    for (std::string& sentence : BlurWarnings(report.light->camera)) {
      report.warnings.push_back(std::move(sentence));
    }
    for (std::string& sentence : LightWarnings(*report.light, report.light_changes.rows)) {
      report.warnings.push_back(std::move(sentence));
    }
  }
  report.files.outputs.emplace_back("report.json");
  report.files.outputs.emplace_back("report.html");
  std::sort(report.files.outputs.begin(), report.files.outputs.end());
  const std::chrono::duration<double, std::milli> taken =
      std::chrono::steady_clock::now() - state.begun;
  state.times.Add(kWholeReplay, taken.count());
  report.timings = state.times.Summarize();
  PLEINAIR_RETURN_IF_ERROR(
      WriteFileAtomically(state.folder.staging() / "report.json", ReportJson(report)));
  return WriteFileAtomically(state.folder.staging() / "report.html", ReportHtml(report));
}

/// Runs all steps, from opening the recording to the finished files.
Result<void> Run(ReplayState& state) {
  PLEINAIR_ASSIGN_OR_RETURN(PreparedReplay prepared, Prepare(state));
  const std::string& name = state.report.call.recording;
  if (state.write.is_resumable) {
    PLEINAIR_RETURN_IF_ERROR(
        ClaimUnfinished(state.folder.staging(), state.options.command,
                        InputsOf(prepared.recording, state.options, state.folder.staging())));
  }
  const auto damage = prepared.recording.damage;
  PLEINAIR_RETURN_IF_ERROR(FindMarkers(state, std::move(prepared.recording)));
  for (const std::string& lost : *damage) state.report.warnings.push_back(lost);
  if (prepared.trajectory) {
    prepared.trajectory->clock_start_ns = state.report.film.clock_start_ns;
    PLEINAIR_RETURN_IF_ERROR(state.pipeline->FollowTrajectory(*prepared.trajectory));
  }
  PLEINAIR_RETURN_IF_ERROR(WriteTrajectories(state));
  if (state.DrawsDay()) PLEINAIR_RETURN_IF_ERROR(ViewOfDay(state));
  Warn(state);
  PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(name));
  PLEINAIR_RETURN_IF_ERROR(EstimateLight(state));
  PLEINAIR_RETURN_IF_ERROR(MeasureLens(state));
  PLEINAIR_RETURN_IF_ERROR(TraceLight(state));
  PLEINAIR_RETURN_IF_ERROR(ComposeFrames(state));
  PLEINAIR_RETURN_IF_ERROR(DrawDay(state));
  PLEINAIR_RETURN_IF_ERROR(WriteReports(state));
  PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(name));
  // They served the resumption alone, and do so again if the results cannot be moved.
  if (state.write.is_resumable && !state.write.frames)
    return SetFramesAside(state.folder.staging());
  return {};
}

/// The output must not replace the recording.
Result<void> CheckOutputIsApart(const ReplayOptions& options) {
  std::error_code error;
  const bool same = fs::equivalent(options.output, options.recording, error) ||
                    fs::equivalent(options.output / "composite.mp4", options.recording, error);
  if (!same) return {};
  return InputError(options.output.string(), "is the recording itself",
                    "name another folder with -o");
}

}  // namespace

std::vector<fs::path> FilesReadBy(const ReplayOptions& options) {
  const auto recording =
      devices::OpenRecording(options.recording, {options.calibration, options.scene});
  if (recording && recording->scene) return InputsOf(*recording, options, {});
  std::vector<fs::path> files{options.recording};
  if (options.scene) files.push_back(*options.scene);
  return files;
}

Result<ReplayReport> Replay(const ReplayOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(CheckOutputIsApart(options));
  // Checked before any file is created: a wrong name must not touch the disk.
  std::error_code error;
  if (!fs::exists(options.recording, error)) {
    return InputError(options.recording.string(), "does not exist", "check the name");
  }
  PLEINAIR_RETURN_IF_ERROR(CheckLightCache(options.light.cache));
  const InterruptGuard guard;
  PLEINAIR_ASSIGN_OR_RETURN(OutputFolder folder,
                            OutputFolder::Create(options.output, options.write.is_resumable));
  constexpr const char* kGoOn = "repeat the command to go on";
  std::optional<InterruptDeadline> deadline(
      std::in_place, options.recording.string(), folder.CleanUp(),
      options.write.is_resumable ? kGoOn : "nothing was written");
  PLEINAIR_ASSIGN_OR_RETURN(const auto calibration, CalibrateFromFilm(options, folder));
  ReplayOptions calibrated = options;
  if (calibration) calibrated.calibration = calibration->file;
  ReplayState state{.options = calibrated, .folder = std::move(folder)};
  if (calibration) {
    state.report.warnings.push_back(calibration->sentence);
    state.report.files.outputs.emplace_back(calibration->file.filename().string());
  }
  Result<void> done = Run(state);
  deadline.reset();  // The files appear together: all or none.
  if (done) done = state.folder.Commit();
  if (!done) {
    Error failure = state.folder.InTermsOfTarget(done.error());
    if (state.write.is_resumable && InterruptGuard::Interrupted()) {
      failure.remedy = kGoOn;
    }
    return tl::make_unexpected(std::move(failure));
  }
  return std::move(state.report);
}

}  // namespace pleinair::app
