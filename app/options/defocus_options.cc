#include "app/options/defocus_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <string_view>

#include "files/csv.h"

namespace pleinair::app {
namespace {

constexpr int kMaxPlaces = 1024;
constexpr std::string_view kLens = "lens:";

/// A whole number that fills the text.
std::optional<int> IntegerIn(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

void AddDefocusOptions(CLI::App& command, DefocusArguments& arguments) {
  command
      .add_option("--defocus", arguments.mode,
                  "Blur of virtual objects by their distance: auto, by [lens] of scene or "
                  "recording, else measured on the marker (default); off; stated, by scene or "
                  "options alone; measured, by the frames alone")
      ->check(CLI::IsMember({"auto", "off", "stated", "measured"}))
      ->type_name("MODE");
  command
      .add_option("--focus", arguments.focus,
                  "Distance in focus, metres along the optical axis, or infinity; overrides the "
                  "scene")
      ->type_name("M");
  command
      .add_option("--aperture-mm", arguments.aperture_mm,
                  "Diameter of the lens's entrance pupil, focal length / f-number; overrides the "
                  "scene")
      ->type_name("D");
  command
      .add_option("--defocus-method", arguments.method,
                  "layered spreads each surface over its circle of confusion (default); lens:N "
                  "draws through N places on the stop, 1 to 1024: slow, the reference")
      ->type_name("METHOD");
}

Result<void> ParseDefocus(const DefocusArguments& arguments, session::DefocusOptions* defocus) {
  using session::LensFactMode;
  defocus->mode = session::LensFactModeOf(arguments.mode);
  const auto has_no_effect = [&](const char* option) {
    return InputError(option, "has no effect with --defocus " + arguments.mode,
                      "leave out one of them");
  };
  const bool is_off = defocus->mode == LensFactMode::kOff;
  const bool ignores_stated = is_off || defocus->mode == LensFactMode::kMeasured;
  if (!arguments.focus.empty()) {
    if (ignores_stated) return has_no_effect("--focus");
    const std::optional<double> focus_m = files::ParseNumber(arguments.focus);
    const bool is_infinite = arguments.focus == "infinity";
    if (!is_infinite && !(focus_m && *focus_m > 0.0 && std::isfinite(*focus_m))) {
      return InputError("--focus", "is not greater than zero: " + arguments.focus.substr(0, 64),
                        "write metres, or infinity");
    }
    defocus->focus_dioptres = is_infinite ? 0.0 : 1.0 / *focus_m;
  }
  if (arguments.aperture_mm) {
    if (ignores_stated) return has_no_effect("--aperture-mm");
    if (!(*arguments.aperture_mm > 0.0) || !std::isfinite(*arguments.aperture_mm)) {
      return InputError("--aperture-mm", "is not greater than zero",
                        "write the diameter of the entrance pupil in millimetres");
    }
    defocus->aperture_m = *arguments.aperture_mm * 1e-3;
  }
  if (arguments.method.empty()) return {};
  if (is_off) return has_no_effect("--defocus-method");
  if (arguments.method == "layered") return {};
  const std::string_view method = arguments.method;
  const std::optional<int> places =
      method.starts_with(kLens) ? IntegerIn(method.substr(kLens.size())) : std::nullopt;
  if (!places || *places < 1 || *places > kMaxPlaces) {
    return InputError("--defocus-method", "is unknown: " + arguments.method.substr(0, 64),
                      "write layered, or lens:1 to lens:1024");
  }
  defocus->places = *places;
  return {};
}

std::string DefocusOptionText(const DefocusArguments& arguments) {
  std::string text;
  if (!arguments.mode.empty()) text += " --defocus " + arguments.mode;
  if (!arguments.focus.empty()) text += " --focus " + arguments.focus;
  if (arguments.aperture_mm) text += fmt::format(" --aperture-mm {}", *arguments.aperture_mm);
  if (!arguments.method.empty()) text += " --defocus-method " + arguments.method;
  return text;
}

}  // namespace pleinair::app
