#include "app/options/antialiasing_options.h"

#include <CLI/CLI.hpp>
#include <vector>

namespace pleinair::app {

using compositor::Antialiasing;
using compositor::AntialiasingMethod;

void AddAntialiasingOptions(CLI::App& command, AntialiasingArguments& arguments) {
  std::vector<std::string> names;
  for (const AntialiasingMethod method : compositor::kAntialiasingMethods) {
    names.emplace_back(compositor::NameOf(method));
  }
  command
      .add_option("--antialiasing", arguments.method,
                  "Edges of virtual objects and shadows: subpixel, coverage at 64 places of pixels "
                  "with edges "
                  "(default); msaa, four samples a pixel, faster; none, the pixel's centre; "
                  "reference, every place of a pixel drawn and shaded for itself, slow")
      ->check(CLI::IsMember(names))
      ->type_name("METHOD");
  command
      .add_option("--antialiasing-samples", arguments.samples,
                  "Places of a pixel for --antialiasing subpixel and reference; default 64")
      ->check(CLI::IsMember({4, 8, 16, 32, 64}))
      ->type_name("N");
}

Result<Antialiasing> ParseAntialiasing(const AntialiasingArguments& arguments) {
  Antialiasing antialiasing;
  for (const AntialiasingMethod method : compositor::kAntialiasingMethods) {
    if (arguments.method == compositor::NameOf(method)) antialiasing.method = method;
  }
  if (!arguments.samples) return antialiasing;
  if (!antialiasing.HasPlaces()) {
    return InputError("--antialiasing-samples", "applies to --antialiasing subpixel and reference",
                      "leave it out, or choose one of these methods");
  }
  antialiasing.places = *arguments.samples;
  return antialiasing;
}

std::string AntialiasingOptionText(const AntialiasingArguments& arguments) {
  std::string text;
  if (!arguments.method.empty()) text += " --antialiasing " + arguments.method;
  if (arguments.samples) text += " --antialiasing-samples " + std::to_string(*arguments.samples);
  return text;
}

}  // namespace pleinair::app
