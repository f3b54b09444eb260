#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/command.h"
#include "app/options/light_options.h"
#include "app/options/number_range.h"
#include "app/options/option_use.h"
#include "app/options/picture_size.h"
#include "app/replay/replay.h"
#include "app/replay/report/report_json.h"
#include "gl/shader_library.h"

namespace pleinair::app {
namespace {

/// Every method by its name in docs/method/shadows.md, three by a word too.
std::map<std::string, compositor::ShadowMethod> ShadowMethodsByName() {
  std::map<std::string, compositor::ShadowMethod> methods{
      {"disc", compositor::ShadowMethod::kSunDisc},
      {"gaussian", compositor::ShadowMethod::kGaussian},
      {"variance", compositor::ShadowMethod::kVariance}};
  for (const auto& traits : shadows::ShadowMethods()) {
    methods.emplace(traits.name, traits.method);
  }
  return methods;
}

constexpr const char* kExamples =
    "Examples:\n"
    "  pleinair replay recordings/courtyard_midday -o out/demo\n"
    "  pleinair replay site/ -o out/site --frames --size 1280x720\n"
    "  pleinair replay site/ -o out/site --sun-to-sky 0   (no sun shone)\n"
    "  pleinair replay site/ -o out/site --frames --export gltf,colmap   (for film tools)\n"
    "  pleinair replay site/ -o out/site --time-lapse 05:00..21:00 --every 10min   (the day)\n"
    "  pleinair replay walk.mp4 --calibration phone.yaml --scene site/scene.toml -o out/walk\n"
    "Writes composite.mp4, poses/MARKER.tum, detections.jsonl, report.json, report.html and, with\n"
    "--frames, frames/0000.png and so on. docs/guide/reference/recordings.md describes recordings "
    "and scenes.";

/// As the parser filled it in.
struct Arguments {
  ReplayOptions options;
  std::string recording, output, scene, calibration, size, shader_directory;
  std::vector<std::string> exports;
  std::vector<double> fog;
  std::string time_lapse, every = "10min";
  std::optional<std::int64_t> time_lapse_frame;
  std::vector<int> shadow_sizes;
  std::string shadows = "disc";
  bool no_video = false;
  bool json = false;
};

/// A word as a shell takes it.
std::string Quoted(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,=+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// A line of messages stays one whatever a folder is called, and the terminal is left alone.
std::string OneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return text;
}

std::string CommandText(const Arguments& arguments) {
  std::string text =
      "pleinair replay " + Quoted(arguments.recording) + " -o " + Quoted(arguments.output);
  if (!arguments.scene.empty()) text += " --scene " + Quoted(arguments.scene);
  if (!arguments.calibration.empty()) text += " --calibration " + Quoted(arguments.calibration);
  const session::LightOptions& light = arguments.options.light;
  if (!light.camera_response.empty()) {
    text += " --response " + Quoted(light.camera_response.string());
  }
  if (arguments.options.write_frames) text += " --frames";
  if (!arguments.size.empty()) text += " --size " + arguments.size;
  for (std::size_t i = 0; i < arguments.exports.size(); ++i) {
    text += (i == 0 ? " --export " : ",") + arguments.exports[i];
  }
  if (!light.cache.empty()) text += " --light-cache " + Quoted(light.cache.string());
  if (light.sky_division != 1) text += fmt::format(" --sky-division {}", light.sky_division);
  if (light.convergence != session::LightOptions{}.convergence) {
    text += fmt::format(" --convergence {}", light.convergence);
  }
  const compositor::LightOverrides& given = light.overrides;
  if (given.max_patches) text += " --light-patches " + std::to_string(*given.max_patches);
  if (given.as_described) text += " --light stated";
  if (!light.match_look) text += " --look clean";
  if (light.hands_in_front) text += " --hands";
  if (given.sun_to_sky) text += fmt::format(" --sun-to-sky {}", *given.sun_to_sky);
  if (given.heading_deg) text += fmt::format(" --heading {}", *given.heading_deg);
  if (arguments.shadows != "disc") text += " --shadows " + arguments.shadows;
  const int partitions = arguments.options.composer.shadow_partitions;
  if (partitions != compositor::ComposerOptions{}.shadow_partitions) {
    text += " --shadow-partitions " + std::to_string(partitions);
  }
  const double weight = arguments.options.composer.shadow_split_weight;
  if (weight != compositor::ComposerOptions{}.shadow_split_weight) {
    text += fmt::format(" --shadow-split-weight {}", weight);
  }
  const double blur_m = arguments.options.composer.shadow_blur_distance_m;
  if (blur_m != compositor::ComposerOptions{}.shadow_blur_distance_m) {
    text += fmt::format(" --shadow-blur {}", blur_m);
  }
  if (!arguments.shadow_sizes.empty()) {
    text += fmt::format(" --shadow-sizes {}", fmt::join(arguments.shadow_sizes, ","));
  }
  if (!arguments.fog.empty()) text += fmt::format(" --fog {}", fmt::join(arguments.fog, ","));
  if (!arguments.time_lapse.empty()) {
    text += " --time-lapse " + Quoted(arguments.time_lapse) + " --every " + Quoted(arguments.every);
  }
  if (arguments.time_lapse_frame) {
    text += fmt::format(" --time-lapse-frame {}", *arguments.time_lapse_frame);
  }
  if (arguments.options.composer.show_shadow_maps) text += " --shadow-debug";
  if (!arguments.shader_directory.empty()) {
    text += " --shader-dir " + Quoted(arguments.shader_directory);
  }
  if (arguments.no_video) text += " --no-video";
  return text;
}

Result<void> Run(const CLI::App& command, Arguments& arguments) {
  ReplayOptions& options = arguments.options;
  constexpr const char* kCoefficients = "daylight coefficients (--light-cache or --time-lapse)";
  const bool coefficients = !options.light.cache.empty() || !arguments.time_lapse.empty();
  PLEINAIR_RETURN_IF_ERROR(
      RefuseUnusedOptions(command, {{"--sky-division", coefficients, kCoefficients},
                                    {"--convergence", coefficients, kCoefficients}}));
  options.recording = arguments.recording;
  options.output = arguments.output;
  if (!arguments.scene.empty()) options.scene = arguments.scene;
  if (!arguments.calibration.empty()) options.calibration = arguments.calibration;
  if (!arguments.size.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(options.size, ParsePictureSize("--size", arguments.size));
  }
  if (!arguments.time_lapse.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(options.time_lapse,
                              ParseTimeLapse(arguments.time_lapse, arguments.every));
    options.time_lapse->frame = arguments.time_lapse_frame;
  }
  for (const std::string& name : arguments.exports) {
    options.exports.insert(exports::TrajectoryFormatNamed(name).value());
  }
  options.composer.shadow_method = ShadowMethodsByName().at(arguments.shadows);
  if (!arguments.shader_directory.empty()) {
    gl::ShaderLibrary::SetOverrideDirectory(arguments.shader_directory);
  }
  if (!arguments.shadow_sizes.empty()) {
    auto& sizes = options.composer.shadow_sizes;
    sizes.fill(arguments.shadow_sizes.back());
    std::copy(arguments.shadow_sizes.begin(), arguments.shadow_sizes.end(), sizes.begin());
  }
  if (!arguments.fog.empty()) {
    // Partitions that are not named are like the last that is.
    options.composer.fog.fill(arguments.fog.back());
    std::copy(arguments.fog.begin(), arguments.fog.end(), options.composer.fog.begin());
  }
  options.write_video = !arguments.no_video;
  options.command = CommandText(arguments);
  PLEINAIR_ASSIGN_OR_RETURN(const ReplayReport report, Replay(options));
  if (arguments.json) {
    std::cout << SummaryJson(report, options.output) << '\n';
    return {};
  }
  std::cerr << report.path.size() << " of " << report.frames << " frames have a pose";
  if (report.reference_marker)
    std::cerr << " (marker " << report.reference_marker->ToString() << ")";
  std::cerr << "; ";
  std::cerr << "results in " << OneLine(arguments.output) << ":";
  for (const std::string& output : report.outputs) std::cerr << ' ' << output;
  std::cerr << '\n';
  for (const std::string& warning : report.warnings) {
    std::cerr << "warning: " << OneLine(warning) << '\n';
  }
  return {};
}

}  // namespace

void AddReplayCommand(CLI::App& app, CommandResult& result) {
  CLI::App* command =
      app.add_subcommand("replay", "Compose the virtual objects of a scene into a recording");
  command->footer(kExamples);
  auto arguments = std::make_shared<Arguments>();
  command
      ->add_option("RECORDING", arguments->recording,
                   "Folder of a recording (own form or EuRoC), or a video file")
      ->required();
  command->add_option("-o,--output", arguments->output, "Folder for the results")->required();
  command->add_option("--scene", arguments->scene,
                      "Scene file (TOML or JSON) instead of the recording's own");
  command->add_option("--calibration", arguments->calibration,
                      "Calibration of the lens (own JSON, OpenCV, ROS or Kalibr YAML)");
  command->add_flag("--frames", arguments->options.write_frames,
                    "Also write every frame as a PNG picture");
  command
      ->add_option("--export", arguments->exports,
                   "Also write the camera's path for other programs: gltf (camera.glb), colmap "
                   "or colmap-binary (colmap/), euroc (poses/MARKER.csv), mcap (camera.mcap)")
      ->delimiter(',')
      ->check(CLI::IsMember({"gltf", "colmap", "colmap-binary", "euroc", "mcap"}))
      ->type_name("FORM,...");
  command->add_option("--size", arguments->size, "Size of the output, WIDTHxHEIGHT in pixels");
  AddLightOptions(*command, arguments->options.light);
  command
      ->add_option("--shadows", arguments->shadows,
                   "How shadows' edges are made: disc (the sun's own width), gaussian (the paper's "
                   "Z-GaF), variance, or another method of docs/method/shadows.md")
      ->check(CLI::IsMember(ShadowMethodsByName()))
      ->type_name("METHOD")
      ->capture_default_str();
  command
      ->add_option("--shadow-partitions", arguments->options.composer.shadow_partitions,
                   "Partitions of the shadow maps")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  command
      ->add_option("--shadow-split-weight", arguments->options.composer.shadow_split_weight,
                   "Lambda of the partitions: 0 even, 1 logarithmic")
      ->check(NumberRange(0.0, 1.0))
      ->capture_default_str();
  command
      ->add_option("--shadow-sizes", arguments->shadow_sizes,
                   "Texels a side of the shadow maps; one number, or one a partition from the "
                   "finest on. Default: as fine as the picture shows, 1024,1024,512,512 up to "
                   "1024 pixels a side, twice that beyond and for --time-lapse")
      ->delimiter(',')
      ->expected(1, 4)
      ->check(CLI::IsMember({128, 256, 512, 1024, 2048, 4096}))
      ->type_name("N,...");
  command
      ->add_option("--shadow-blur", arguments->options.composer.shadow_blur_distance_m,
                   "Methods that blur moments: how far off the blocker is whose edge they are as "
                   "soft as, in metres")
      ->check(NumberRange(0.01, 100.0))
      ->capture_default_str();
  command
      ->add_option("--fog", arguments->fog,
                   "Haze before the virtual objects and their shadows, times the day's own air; "
                   "one number, or one a "
                   "partition from near to far; 0 none. Default: 1")
      ->delimiter(',')
      ->expected(1, 4)
      ->check(NumberRange(0.0, 1e6))
      ->type_name("TIMES,...");
  CLI::Option* time_lapse = command->add_option(
      "--time-lapse", arguments->time_lapse,
      "Also draw the whole scene, phantoms in their own colours, over its day: timelapse.mp4 and "
      "the sheet timelapse.png; with --frames each picture. Hours on a clock, 05:00..21:00 or "
      "05:00..21:00+02:00, or the word day: while it is light");
  time_lapse->type_name("HOURS|day");
  command->add_option("--every", arguments->every, "Step of the time-lapse: 10min, 90s, 1h")
      ->needs(time_lapse)
      ->capture_default_str();
  command
      ->add_option("--time-lapse-frame", arguments->time_lapse_frame,
                   "Frame from whose camera the time-lapse is seen; default: the middle one")
      ->needs(time_lapse)
      ->check(CLI::NonNegativeNumber);
  command->add_flag("--shadow-debug", arguments->options.composer.show_shadow_maps,
                    "Tint what each partition of the shadow maps serves and show the maps");
  command
      ->add_option("--shader-dir", arguments->shader_directory,
                   "Folder with shaders to use instead of the built-in ones, for development")
      ->check(CLI::ExistingDirectory);
  command->add_flag("--no-video", arguments->no_video, "Do not write composite.mp4");
  command->add_flag("--json", arguments->json, "Print a summary as one JSON object");
  command->callback([arguments, command, &result] {
    try {
      result.status = Run(*command, *arguments);
    } catch (const std::exception& error) {
      result.status = SystemError("", std::string("replay failed: ") + error.what(),
                                  "please report it with the recording");
    }
  });
}

}  // namespace pleinair::app
