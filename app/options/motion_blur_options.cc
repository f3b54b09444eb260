#include "app/options/motion_blur_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

namespace pleinair::app {

void AddMotionBlurOptions(CLI::App& command, MotionBlurArguments& arguments) {
  command
      .add_option(
          "--motion-blur", arguments.mode,
          "Blur of virtual objects by the camera's motion while a frame is exposed: auto, "
          "by the exposure of scene, recording or frames, else measured on the marker; off; "
          "stated, by scene or options alone; measured, by the frames alone. By default "
          "replay takes auto, and live off")
      ->check(CLI::IsMember({"auto", "off", "stated", "measured"}))
      ->type_name("MODE");
  command
      .add_option("--exposure-ms", arguments.exposure_ms,
                  "Time for which the shutter is open, milliseconds; overrides the scene")
      ->type_name("T");
}

Result<void> ParseMotionBlur(const MotionBlurArguments& arguments,
                             session::MotionBlurOptions* motion_blur) {
  using session::LensFactMode;
  motion_blur->mode = session::LensFactModeOf(arguments.mode);
  if (!arguments.exposure_ms) return {};
  if (motion_blur->mode == LensFactMode::kOff || motion_blur->mode == LensFactMode::kMeasured) {
    return InputError("--exposure-ms", "has no effect with --motion-blur " + arguments.mode,
                      "leave out one of them");
  }
  if (!(*arguments.exposure_ms > 0.0) || !std::isfinite(*arguments.exposure_ms)) {
    return InputError("--exposure-ms", "is not greater than zero",
                      "write the milliseconds for which the shutter is open");
  }
  motion_blur->exposure_s = *arguments.exposure_ms * 1e-3;
  return {};
}

std::string MotionBlurOptionText(const MotionBlurArguments& arguments) {
  std::string text;
  if (!arguments.mode.empty()) text += " --motion-blur " + arguments.mode;
  if (arguments.exposure_ms) text += fmt::format(" --exposure-ms {}", *arguments.exposure_ms);
  return text;
}

}  // namespace pleinair::app
