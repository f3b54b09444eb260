#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/commands/command.h"
#include "app/live/live_arguments.h"
#include "app/live/live_messages.h"
#include "app/live/live_report.h"
#include "app/live/live_session.h"
#include "app/live/live_source.h"
#include "app/live/scene_file.h"
#include "app/options/light_options.h"
#include "app/options/model_options.h"
#include "app/options/number_range.h"
#include "app/options/option_use.h"
#include "app/options/picture_size.h"
#include "app/replay/replay.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/interrupt_deadline.h"
#include "export/images/image_writer.h"
#ifdef PLEINAIR_WINDOW
#include "app/window/live_window.h"
#endif
#include "devices/cameras/live_camera.h"

namespace pleinair::app {
namespace {

constexpr const char* kLiveExamples =
    "Examples:\n"
    "  pleinair live --camera v4l2:/dev/video0 --calibration camera.json --scene site/scene.toml "
    "--headless --seconds 60\n"
    "  pleinair live --camera v4l2:serial=0001 --calibration camera.json --scene site/scene.toml\n"
    "      --hold-exposure 0.008 --record out/walk --headless\n"
    "  pleinair live --camera file:recordings/courtyard_midday --loop\n"
    "  pleinair live --camera file:site --loop --save-scene site/moved.toml\n"
    "      (arrange the objects, save with Ctrl+S, then 'pleinair replay site --scene "
    "site/moved.toml')\n"
    "  pleinair live --camera file:recordings/courtyard_midday --headless --lossless\n"
    "  pleinair live --camera file:recordings/courtyard_midday --light-changes hold\n"
    "  pleinair live --camera file:recordings/courtyard_midday --headless --record out/take "
    "-o out/live\n"
    "      (poses to compare with those of 'pleinair replay out/take -o out/replayed')\n"
    "'pleinair devices' lists cameras. If the camera is not connected, live waits for it, also\n"
    "after it was unplugged. Ctrl-C ends. docs/guide/live.md describes the window,\n"
    "docs/guide/cameras.md cameras.";

// Interval of the reports in a long run, if they are enabled.
constexpr double kReportEvery_s = 60.0;

/// Reports every requested option that has no effect.
Result<void> CheckLiveOptions(const CLI::App& command, const LiveArguments& arguments,
                              bool is_file) {
  constexpr const char* kCameras = "cameras, not to recordings";
  constexpr const char* kWindow = "the window";
  constexpr const char* kPaced = "sessions at a camera's pace, without --lossless";
  constexpr const char* kCoefficients =
      "daylight coefficients, which --lossless uses only with --light-cache";
  const bool coefficients = !arguments.lossless || !arguments.light.cache.empty();
  PLEINAIR_RETURN_IF_ERROR(RefuseUnusedOptions(
      command, {{"--format", !is_file, kCameras},
                {"--lock", !is_file, kCameras},
                {"--hold-exposure", !is_file, kCameras},
                {"--hold-gain", !is_file, kCameras},
                {"--hold-white-balance", !is_file, kCameras},
                {"--hold-focus", !is_file, kCameras},
                {"--loop", is_file, "recordings"},
                {"--sky-division", coefficients, kCoefficients},
                {"--convergence", coefficients, kCoefficients},
                {"--rate", !arguments.lossless, kPaced},
                {"--light-changes", !arguments.lossless, kPaced},
                {"--window", !arguments.headless, kWindow},
                {"--ui-scale", !arguments.headless, kWindow},
                {"--pictures", !arguments.headless, kWindow},
                {"--save-scene", !arguments.headless, kWindow},
                {"--screenshot", arguments.headless, "--headless; in the window press Ctrl+P"}}));
  PLEINAIR_RETURN_IF_ERROR(CheckLightCache(arguments.light.cache));
  if (arguments.output.screenshot.empty()) return {};
  const std::filesystem::path folder =
      std::filesystem::path(arguments.output.screenshot).parent_path();
  std::error_code error;
  if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
    return InputError("--screenshot", "there is no folder " + folder.string(), "make it first");
  }
  return {};
}

/// Draws until the end, the time limit or Ctrl-C; returns the last image.
Result<RgbImage> DrawAll(LiveSession& session, const LiveSource& source,
                         const LiveArguments& arguments, LiveReport* report) {
  using Clock = std::chrono::steady_clock;
  // The time limit counts from the first frame drawn, or from the opening while there is none.
  auto start = Clock::now();
  RgbImage last;
  while (!session.finished() && !InterruptGuard::Interrupted()) {
    if (arguments.seconds &&
        std::chrono::duration<double>(Clock::now() - start).count() >= *arguments.seconds) {
      break;
    }
    ReportEvents(source.camera, arguments.json);
    ReportNews(source.trajectory.get(), arguments.json);
    if (const auto interval = report->Poll(session)) Report(*interval, arguments.json);
    PLEINAIR_ASSIGN_OR_RETURN(auto drawn, session.Draw(std::chrono::milliseconds(50)));
    if (!drawn) continue;
    if (last.empty()) start = Clock::now();
    last = std::move(drawn->picture);
  }
  return last;
}

/// Shows a window until it is closed; there is no last image.
Result<RgbImage> ShowAll([[maybe_unused]] LiveSession& session, [[maybe_unused]] ImageSize window,
                         [[maybe_unused]] const LiveSource& source,
                         [[maybe_unused]] const LiveArguments& arguments,
                         [[maybe_unused]] const scene::SceneDescription& scene,
                         [[maybe_unused]] SceneFile* scene_file,
                         [[maybe_unused]] LiveReport* report) {
#ifdef PLEINAIR_WINDOW
  LiveWindowOptions options;
  options.scene_file = scene_file;
  options.camera = source.lens;
  options.scene = scene;
  options.drawing.show_shadow_maps = arguments.shadow_debug;
  PLEINAIR_ASSIGN_OR_RETURN(options.drawing.antialiasing,
                            ParseAntialiasing(arguments.drawing.antialiasing));
  options.convergence = arguments.light.convergence;
  options.live_camera = source.camera;
  options.seconds = arguments.seconds;
  options.ui_scale = arguments.window.ui_scale;
  options.screenshots = arguments.window.screenshots;
  options.poll_camera = [&] {
    if (const auto interval = report->Poll(session)) Report(*interval, arguments.json);
    const std::string news = ReportNews(source.trajectory.get(), arguments.json);
    std::string event = ReportEvents(source.camera, arguments.json);
    return event.empty() ? news : event;
  };
  options.width = window.width;
  options.height = window.height;
  PLEINAIR_RETURN_IF_ERROR(ShowInWindow(session, options));
#endif
  return RgbImage();
}

/// Returns the memory of freed images to the system. Otherwise the C library keeps it in an arena
/// per thread and fragments it: 110 MB more within minutes (docs/method/live.md).
void KeepNoFreedPictures() {
#ifdef __GLIBC__
  constexpr int kPicture_bytes = 256 * 1024;
  mallopt(M_MMAP_THRESHOLD, kPicture_bytes);
#endif
}

Result<void> RunLive(const CLI::App& command, const LiveArguments& arguments) {
  const auto began = std::chrono::steady_clock::now();
#ifndef PLEINAIR_WINDOW
  if (!arguments.headless) {
    return InputError("live", "was built without a window",
                      "give --headless, or install libglfw3-dev and libimgui-dev and build again");
  }
#endif
  PLEINAIR_ASSIGN_OR_RETURN(const devices::CameraUri uri,
                            devices::ParseCameraUri(arguments.input.camera));
  const bool is_file = uri.backend == devices::CameraUri::Backend::kFile;
  PLEINAIR_RETURN_IF_ERROR(CheckLiveOptions(command, arguments, is_file));
  ImageSize window;
  if (!arguments.window.size.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(window, ParsePictureSize("--window", arguments.window.size));
  }
  PLEINAIR_ASSIGN_OR_RETURN(LiveSource source, OpenLiveSource(uri, arguments));
  if (!source.scene) {
    return InputError("--scene",
                      "is missing: it describes the place, the marker and the virtual objects",
                      "write one (docs/guide/reference/recordings.md)");
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      SceneFile scene_file,
      SceneFile::Open(*source.scene, session::UneditedScene(*source.scene, {}),
                      arguments.window.saved_scene));
  KeepNoFreedPictures();
  LiveOptions options;
  options.began = began;
  options.camera = source.lens;
  options.light = arguments.light;
  options.light.film_response = source.response;
  options.scene = session::WithGiven(*source.scene, arguments.light);
  options.composer.show_shadow_maps = arguments.shadow_debug;
  PLEINAIR_ASSIGN_OR_RETURN(options.composer.antialiasing,
                            ParseAntialiasing(arguments.drawing.antialiasing));
  PLEINAIR_RETURN_IF_ERROR(ParseDefocus(arguments.drawing.defocus, &options.light.defocus));
  PLEINAIR_RETURN_IF_ERROR(
      ParseMotionBlur(arguments.drawing.motion_blur, &options.light.motion_blur));
  // Each view takes about as long as an image at rest, so that a session asks for them.
  constexpr int kLiveViews = 8;
  if (arguments.drawing.motion_blur.mode.empty() && !arguments.drawing.motion_blur.exposure_ms) {
    options.light.motion_blur.mode = session::LensFactMode::kOff;
  }
  options.light.motion_blur.max_views = kLiveViews;
  options.scene.camera.recorded_lens = session::StatedLens(options.scene, options.light);
  const scene::SceneDescription scene = options.scene;
  options.shown_elsewhere = !arguments.headless;
  options.lossless = arguments.lossless;
  PLEINAIR_ASSIGN_OR_RETURN(options.start, StartOf(arguments, source));
  if (!arguments.output.recording.empty()) options.record = arguments.output.recording;
  if (!arguments.output.detections.empty()) options.detections = arguments.output.detections;
  if (!arguments.output.folder.empty()) {
    options.output.emplace().folder = arguments.output.folder;
    for (const std::string& name : arguments.output.exports) {
      options.output->exports.insert(exports::TrajectoryFormatNamed(name).value());
    }
  }
  if (source.camera != nullptr) {
    options.source.stop = [camera = source.camera] { camera->Stop(); };
  }
  options.source.trajectory = source.trajectory;
  const InterruptGuard guard;
  std::optional<InterruptDeadline> deadline(
      std::in_place, arguments.input.camera, [] {}, "no image was composed");
  PLEINAIR_ASSIGN_OR_RETURN(auto session,
                            LiveSession::Create(std::move(source.frames), std::move(options),
                                                [&](const std::vector<std::string>& warnings) {
                                                  deadline.reset();
                                                  for (const std::string& warning : warnings) {
                                                    std::cerr << "warning: " << warning << '\n';
                                                  }
                                                }));
  LiveReport report(arguments.report_every_s.value_or(arguments.json ? kReportEvery_s : 0.0));
  auto last = arguments.headless
                  ? DrawAll(*session, source, arguments, &report)
                  : ShowAll(*session, window, source, arguments, scene, &scene_file, &report);
  ReportEvents(source.camera, arguments.json);
  if (source.trajectory) source.trajectory->Stop();
  ReportNews(source.trajectory.get(), arguments.json);
  ReportControls(source.camera);
  session->Stop();
  if (const auto interval = report.Finish(*session)) Report(*interval, arguments.json);
  Report(session->statistics(), arguments.json);
  if (session->FailedToKeepLight()) {
    std::cerr << "warning: " << CouldNotKeepLight(arguments.light.cache) << '\n';
  }
  if (!last) return tl::make_unexpected(last.error());
  if (!arguments.output.screenshot.empty()) {
    if (last->empty()) {
      return SystemError("--screenshot", "no frame was drawn before the end",
                         "give more --seconds");
    }
    PLEINAIR_RETURN_IF_ERROR(exports::WritePng(arguments.output.screenshot, last->view()));
  }
  if (auto trouble = session->output_trouble()) return tl::make_unexpected(*trouble);
  if (auto trouble = session->recording_trouble()) return tl::make_unexpected(*trouble);
  return {};
}

}  // namespace

void AddLiveCommand(CLI::App& app, CommandResult& result) {
  CLI::App* command =
      app.add_subcommand("live", "Show a scene's virtual objects in a camera's live images");
  command->footer(kLiveExamples);
  auto arguments = std::make_shared<LiveArguments>();
  LiveArguments& a = *arguments;
  command->add_option("--camera", a.input.camera, "Which camera, or file:PATH of a recording")
      ->type_name("URI")
      ->required();
  command->add_option("--scene", a.input.scene, "Scene file (docs/guide/reference/recordings.md)");
  command->add_option("--calibration", a.input.calibration, "Calibration of the lens");
  command->add_option("--time", a.input.time,
                      "Moment of the first frame: RFC 3339, local time with its zone, or \"now\" "
                      "(the default for cameras; "
                      "for recordings the scene's)");
  command->add_option("--record", a.output.recording, "Record into this new folder, too");
  command->add_option("--detections", a.output.detections,
                      "Write the detections, one JSON line a frame");
  CLI::Option* output =
      command
          ->add_option(
              "-o,--output", a.output.folder,
              "Folder for what replay writes of a recording: poses/MARKER.tum, light.csv and "
              "detections.jsonl; markers are measured as in replay, some 20 ms each")
          ->type_name("FOLDER");
  command
      ->add_option("--export", a.output.exports,
                   "With -o, also write the camera's trajectory for other programs: gltf, colmap "
                   "or colmap-binary, euroc, mcap")
      ->delimiter(',')
      ->check(CLI::IsMember({"gltf", "colmap", "colmap-binary", "euroc", "mcap"}))
      ->type_name("FORM,...")
      ->needs(output);
  command
      ->add_option("--report-every", a.report_every_s,
                   "Report frames, latency and memory at this interval in seconds; 0: never. "
                   "Default: 60 with --json, else 0")
      ->check(NumberRange(0.0, 1e9));
  command->add_option("--screenshot", a.output.screenshot,
                      "At the end, write the last image as PNG");
  AddLightOptions(*command, a.light);
  AddLightChangeOption(*command, "the time between two estimates, a minute", a.light);
  AddSolverOptions(*command, a.light);
  AddModelFileOptions(*command);
  AddAntialiasingOptions(*command, a.drawing.antialiasing);
  AddDefocusOptions(*command, a.drawing.defocus);
  AddMotionBlurOptions(*command, a.drawing.motion_blur);
  command->add_flag("--shadow-debug", a.shadow_debug,
                    "Tint surfaces by shadow-map partition and show the maps (in the window: M)");
  command->add_flag("--headless", a.headless, "Without a window");
  command
      ->add_option("--seconds", a.seconds,
                   "End this many seconds after the first frame is shown, or after the session has "
                   "opened if the camera gives none. Opening takes some more")
      ->check(NumberRange(0.0, 1e9));
  command->add_option("--window", a.window.size, "Size of the window, WIDTHxHEIGHT");
  command->add_option("--ui-scale", a.window.ui_scale, "Scale of the window's text; 1 is usual")
      ->check(NumberRange(0.5, 8.0));
  command
      ->add_option("--pictures", a.window.screenshots,
                   "Folder for the window's screenshots and recordings")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  command
      ->add_option("--save-scene", a.window.saved_scene,
                   "Where the window saves the edited scene: a new file. Default: the scene's own "
                   "scene.toml")
      ->type_name("FILE");
  command->add_flag("--loop", a.input.loop, "Play a recording again and again");
  command->add_flag("--lossless", a.lossless,
                    "Of a recording, track and draw every frame, however long that takes");
  command
      ->add_option("--rate", a.input.rate_hz,
                   "Frame rate to request from the camera, or to play a recording at")
      ->check(NumberRange(0.1, 1000.0));
  command->add_option("--format", a.input.pixel_format,
                      "Pixel format to request: YUYV, MJPG, NV12, GREY…");
  command->add_flag("--lock", a.input.holds.all,
                    "Lock exposure, gain, white balance and focus at their current values");
  command
      ->add_option("--hold-exposure", a.input.holds.exposure_s,
                   "Lock the exposure at this value, in seconds")
      ->check(NumberRange(1e-6, 100.0));
  command
      ->add_option("--hold-gain", a.input.holds.gain,
                   "Lock the gain at this value, in the camera's own units")
      ->check(NumberRange(0.0, 1e6));
  command
      ->add_option("--hold-white-balance", a.input.holds.white_balance_k,
                   "Lock the white balance at this value, in kelvins")
      ->check(NumberRange(1000.0, 40000.0));
  command
      ->add_option("--hold-focus", a.input.holds.focus,
                   "Lock the focus at this value, in the camera's own units")
      ->check(NumberRange(0.0, 1e6));
  command->add_flag("--json", a.json, "Events and statistics as JSON lines");
  command->callback(
      [command, arguments, &result] { result.status = RunLive(*command, *arguments); });
}

}  // namespace pleinair::app
