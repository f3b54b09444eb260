#include "app/options/light_options.h"

#include <fmt/format.h>

#include <system_error>

#include <CLI/CLI.hpp>

#include "app/options/number_range.h"

namespace pleinair::app {

void AddLightOptions(CLI::App& command, session::LightOptions& options) {
  command.add_option(
      "--response", options.camera_response,
      "Response of the camera: a file (docs/guide/reference/calibrations.md), or srgb; instead of "
      "the scene's, or of what the frames show");
  command
      .add_option_function<std::string>(
          "--light",
          [&options](const std::string& from) {
            options.overrides.as_described = from == "stated";
            options.overrides.fitted = from == "fitted";
          },
          "measured: sun, sky and heading from the shadows that phantoms cast in the frames; "
          "fitted: the same by one fit to all evidence, on trial; stated: from the scene")
      ->check(CLI::IsMember({"measured", "fitted", "stated"}))
      ->default_str("measured");
  command.add_option("--light-cache", options.cache,
                     "Folder for daylight coefficients: traced once for a scene, then any moment's "
                     "light takes milliseconds; for long days and for trying out");
  command
      .add_option("--sun-to-sky", options.overrides.sun_to_sky,
                  "The sun's light on level ground over the sky's, instead of measuring it: 4 on "
                  "a clear noon, 0.5 in thick haze, 0 where no sun shines")
      ->check(NumberRange(0.0, compositor::kMaxSunToSky));
  command
      .add_option("--heading", options.overrides.heading_deg,
                  "Heading of the marker in degrees, instead of the scene's, and not refined")
      ->check(NumberRange(-360.0, 360.0));
  command
      .add_option_function<std::string>(
          "--look", [&options](const std::string& look) { options.match_look = look == "matched"; },
          "matched: virtual objects get the blur and the noise of the frames, measured on the "
          "marker; clean: they stay sharp")
      ->check(CLI::IsMember({"matched", "clean"}))
      ->default_str("matched");
  command.add_flag("--hands", options.hands_in_front,
                   "What covers part of the marker (S-G markers and picture targets) is shown in "
                   "front of the virtual objects; its outline is found by its color");
}

void AddLightChangeOption(CLI::App& command, const std::string& of,
                          session::LightOptions& options) {
  command
      .add_option_function<std::string>(
          "--light-changes",
          [&options](const std::string& mode) {
            for (const auto known :
                 {session::LightChangeMode::kFollow, session::LightChangeMode::kHold,
                  session::LightChangeMode::kStated}) {
              if (mode == session::NameOf(known)) options.changes = known;
            }
          },
          "follow: sun and sky are estimated in each frame, for passing clouds; hold: one light "
          "for " +
              of + "; stated: that of the scene's layers of clouds at each moment")
      ->check(CLI::IsMember({"follow", "hold", "stated"}))
      ->default_str("follow");
}

void AddSolverOptions(CLI::App& command, session::LightOptions& options) {
  command
      .add_option("--sky-division", options.sky_division,
                  "Daylight coefficients of Tregenza's 145 patches of the sky: 1; or of Reinhart's "
                  "finer ones, each divided by 2, 3 or 4 a side: sharper reflections of the sun; "
                  "memory and time grow by the square")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  command
      .add_option("--convergence", options.convergence,
                  "Daylight coefficients: interreflections are computed until a bounce adds less "
                  "than this share of all light")
      ->check(NumberRange(0.0001, 0.2))
      ->capture_default_str();
  command
      .add_option("--light-patches", options.overrides.max_patches,
                  "Maximum number of points where light is computed; models of more vertices share "
                  "them by patches. More are finer and slower [100000]")
      ->check(CLI::Range(1'000, 10'000'000));
}

Result<void> CheckLightCache(const std::filesystem::path& cache) {
  std::error_code error;
  if (cache.empty() || std::filesystem::is_directory(cache, error) ||
      !std::filesystem::exists(cache, error)) {
    return {};
  }
  return InputError(cache.string(), "is no folder", "name one for --light-cache, or a new name");
}

std::string CouldNotKeepLight(const std::filesystem::path& cache) {
  return fmt::format(
      "The daylight coefficients could not be written to {}: the next run will trace them again.",
      cache.string());
}

}  // namespace pleinair::app
