#pragma once

#include <optional>
#include <string>

#include "base/error.h"
#include "session/motion/frame_exposure.h"

namespace CLI {
class App;
}

namespace pleinair::app {

/// Values of --motion-blur and --exposure-ms as given; empty: not given.
struct MotionBlurArguments {
  std::string mode;
  std::optional<double> exposure_ms;
};

/// Adds the two options.
void AddMotionBlurOptions(CLI::App& command, MotionBlurArguments& arguments);

/// Reads them into the options of a session. Errors (input): an exposure not greater than zero, or
/// without effect in this mode.
Result<void> ParseMotionBlur(const MotionBlurArguments& arguments,
                             session::MotionBlurOptions* motion_blur);

/// The options as on a command line, with a space before each; empty where none was given.
std::string MotionBlurOptionText(const MotionBlurArguments& arguments);

}  // namespace pleinair::app
