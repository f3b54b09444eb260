#include "app/commands/replay_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "app/options/picture_size.h"
#include "app/options/shard_option.h"
#include "app/options/trajectory_options.h"
#include "app/output/resumption.h"
#include "app/replay/output_names.h"
#include "app/replay/report/report_json.h"
#include "app/terminal/interrupt.h"
#include "gl/shader_library.h"
#include "shadows/shadow_method.h"

namespace pleinair::app {
namespace {

/// Quotes a word for a shell.
std::string Quoted(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:,=+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Keeps a message on one line and free of terminal codes, whatever a folder is called.
std::string OneLine(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  return text;
}

std::string CommandText(const ReplayArguments& arguments) {
  std::string text = "pleinair " + arguments.command + " " + Quoted(arguments.paths.recording) +
                     " -o " + Quoted(arguments.paths.output);
  if (!arguments.paths.scene.empty()) text += " --scene " + Quoted(arguments.paths.scene);
  if (!arguments.paths.calibration.empty())
    text += " --calibration " + Quoted(arguments.paths.calibration);
  const session::LightOptions& light = arguments.options.light;
  if (!light.camera_response.empty()) {
    text += " --response " + Quoted(light.camera_response.string());
  }
  if (arguments.range.frame) text += fmt::format(" --frame {}", *arguments.range.frame);
  if (arguments.range.from_s) text += fmt::format(" --from {}", *arguments.range.from_s);
  if (arguments.range.to_s) text += fmt::format(" --to {}", *arguments.range.to_s);
  text += TrajectoryOptionText(arguments.options.trajectory, Quoted);
  if (arguments.written.frames) text += " --frames";
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
  if (given.fitted) text += " --light fitted";
  if (light.changes != session::LightOptions{}.changes) {
    text += std::string(" --light-changes ") + session::NameOf(light.changes);
  }
  if (!light.match_look) text += " --look clean";
  if (light.hands_in_front) text += " --hands";
  if (given.sun_to_sky) text += fmt::format(" --sun-to-sky {}", *given.sun_to_sky);
  if (given.heading_deg) text += fmt::format(" --heading {}", *given.heading_deg);
  if (arguments.research.shadows != "ours") text += " --shadows " + arguments.research.shadows;
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
  if (!arguments.research.shadow_sizes.empty()) {
    text += fmt::format(" --shadow-sizes {}", fmt::join(arguments.research.shadow_sizes, ","));
  }
  if (!arguments.drawing.fog.empty())
    text += fmt::format(" --fog {}", fmt::join(arguments.drawing.fog, ","));
  text += AntialiasingOptionText(arguments.drawing.antialiasing);
  text += DefocusOptionText(arguments.drawing.defocus);
  text += MotionBlurOptionText(arguments.drawing.motion_blur);
  if (!arguments.day.hours.empty()) {
    text += " --time-lapse " + Quoted(arguments.day.hours);
    if (!arguments.day.every.empty()) text += " --every " + Quoted(arguments.day.every);
  }
  if (arguments.day.frame) {
    text += fmt::format(" --time-lapse-frame {}", *arguments.day.frame);
  }
  if (arguments.options.composer.show_shadow_maps) text += " --shadow-debug";
  if (!arguments.research.shader_directory.empty()) {
    text += " --shader-dir " + Quoted(arguments.research.shader_directory);
  }
  if (arguments.written.no_video) text += " --no-video";
  return text;
}

Result<void> SetRange(const ReplayArguments& arguments, devices::FrameRange* range) {
  constexpr double kSecond_ns = 1e9;
  const ReplayArguments::Range& given = arguments.range;
  if (given.from_s && given.to_s && *given.from_s > *given.to_s) {
    return InputError("--from", "is after --to", "swap them");
  }
  range->frame = given.frame;
  if (given.from_s) range->from_ns = std::llround(*given.from_s * kSecond_ns);
  if (given.to_s) range->until_ns = std::llround(*given.to_s * kSecond_ns);
  return {};
}

Result<void> Run(ReplayArguments& arguments) {
  ReplayOptions& options = arguments.options;
  options.recording = arguments.paths.recording;
  options.output = arguments.paths.output;
  if (!arguments.paths.scene.empty()) options.scene = arguments.paths.scene;
  if (!arguments.paths.calibration.empty()) options.calibration = arguments.paths.calibration;
  if (!arguments.size.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(options.size, ParsePictureSize("--size", arguments.size));
  }
  if (!arguments.day.hours.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(
        options.time_lapse,
        ParseTimeLapse(arguments.day.hours, arguments.day.every.empty()
                                                ? std::nullopt
                                                : std::optional(arguments.day.every)));
    options.time_lapse->frame = arguments.day.frame;
  }
  for (const std::string& name : arguments.exports) {
    options.write.exports.insert(exports::TrajectoryFormatNamed(name).value());
  }
  options.composer.shadow_method = shadows::FindShadowMethod(arguments.research.shadows)->method;
  if (!arguments.research.shader_directory.empty()) {
    gl::ShaderLibrary::SetOverrideDirectory(arguments.research.shader_directory);
  }
  if (!arguments.research.shadow_sizes.empty()) {
    auto& sizes = options.composer.shadow_sizes;
    sizes.fill(arguments.research.shadow_sizes.back());
    std::copy(arguments.research.shadow_sizes.begin(), arguments.research.shadow_sizes.end(),
              sizes.begin());
  }
  if (!arguments.drawing.fog.empty()) {
    // Partitions without a value use the last value.
    options.composer.fog.fill(arguments.drawing.fog.back());
    std::copy(arguments.drawing.fog.begin(), arguments.drawing.fog.end(),
              options.composer.fog.begin());
  }
  PLEINAIR_ASSIGN_OR_RETURN(options.composer.antialiasing,
                            ParseAntialiasing(arguments.drawing.antialiasing));
  PLEINAIR_RETURN_IF_ERROR(ParseDefocus(arguments.drawing.defocus, &options.light.defocus));
  PLEINAIR_RETURN_IF_ERROR(
      ParseMotionBlur(arguments.drawing.motion_blur, &options.light.motion_blur));
  PLEINAIR_RETURN_IF_ERROR(SetRange(arguments, &options.range));
  // A single picture is no video.
  const bool is_still = arguments.range.frame.has_value();
  options.write.frames = arguments.written.frames || is_still;
  options.write.video = !arguments.written.no_video && !is_still;
  options.write.is_resumable = arguments.written.resume;
  options.command = CommandText(arguments);
  if (arguments.written.resume &&
      IsFinishedReplay(options.output, options.command, FilesReadBy(options))) {
    std::cerr << OneLine(arguments.paths.output)
              << " is finished already; without --resume it is composed anew\n";
    return {};
  }
  PLEINAIR_ASSIGN_OR_RETURN(const ReplayReport report, Replay(options));
  if (arguments.json) {
    std::cout << SummaryJson(report, options.output) << '\n';
    return {};
  }
  std::cerr << report.path.size() << " of " << report.film.frames << " frames have a pose";
  if (report.reference_marker)
    std::cerr << " (marker " << report.reference_marker->ToString() << ")";
  std::cerr << "; ";
  std::cerr << "results in " << OneLine(arguments.paths.output) << ":";
  for (const std::string& output : report.files.outputs) std::cerr << ' ' << output;
  std::cerr << '\n';
  for (const std::string& warning : report.warnings) {
    std::cerr << "warning: " << OneLine(warning) << '\n';
  }
  return {};
}

/// Composes several recordings. One that fails is reported, and the others are composed.
/// Run() whose exceptions end no other recording's replay.
Result<void> RunAlone(ReplayArguments& arguments) {
  try {
    return Run(arguments);
  } catch (const std::bad_alloc&) {
    return SystemError(arguments.paths.recording, "needs more memory than there is",
                       "use a smaller recording or simpler models, or a machine with more");
  } catch (const std::exception& error) {
    return SystemError(arguments.paths.recording, std::string("replay failed: ") + error.what(),
                       "please report it with the recording");
  }
}

Result<void> RunSeveral(const ReplayArguments& arguments) {
  PLEINAIR_ASSIGN_OR_RETURN(const Shard shard, ParseShard(arguments.shard));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<std::string> names,
                            OutputNames(arguments.paths.recordings));
  std::size_t failed = 0, tried = 0;
  for (std::size_t i = static_cast<std::size_t>(shard.index) - 1; i < names.size();
       i += static_cast<std::size_t>(shard.count)) {
    ReplayArguments one = arguments;
    one.paths.recording = arguments.paths.recordings[i];
    one.paths.output = (std::filesystem::path(arguments.paths.output) / names[i]).string();
    ++tried;
    const Result<void> done = RunAlone(one);
    if (InterruptGuard::Interrupted()) {
      return SystemError(arguments.paths.output, "interrupted", "repeat the command");
    }
    if (done) continue;
    ++failed;
    std::cerr << "pleinair: " << OneLine(done.error().Message()) << '\n';
  }
  if (failed == 0) return {};
  return SystemError(arguments.paths.output,
                     fmt::format("{} of {} recordings were not composed", failed, tried),
                     "repair them and repeat the command");
}

}  // namespace

Result<void> RunReplay(ReplayArguments& arguments) {
  if (arguments.paths.recordings.size() != 1 || !arguments.shard.empty()) {
    return RunSeveral(arguments);
  }
  arguments.paths.recording = arguments.paths.recordings.front();
  return RunAlone(arguments);
}

}  // namespace pleinair::app
