#include "app/options/output_options.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>

#include "files/output_rule.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

/// Every option of any command that names what is written.
constexpr std::array<std::string_view, 17> kOutputOptions = {
    "--coverage",    "--description", "--detections", "--euroc",   "--kalibr",  "--opencv",
    "--opencv-json", "--output",      "--path",       "--plan",    "--preview", "--record",
    "--report",      "--ros",         "--screenshot", "--spectra", "OUT"};
/// Folders of files that pleinair names by the time of day.
constexpr std::string_view kPictureFolder = "--pictures";

bool IsOutput(const CLI::Option& option) {
  return std::any_of(kOutputOptions.begin(), kOutputOptions.end(),
                     [&](std::string_view name) { return option.check_name(std::string(name)); });
}

/// "film.mp4" of the camera "file:film.mp4".
std::string FileOf(const std::string& value) {
  constexpr std::string_view kFileCamera = "file:";
  return value.starts_with(kFileCamera) ? value.substr(kFileCamera.size()) : value;
}

struct NamedOutput {
  std::string option, file;
};

Result<void> CheckOptionsOf(const CLI::App& command) {
  std::vector<std::string> inputs;
  std::vector<NamedOutput> outputs;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // A flag.
    if (option->check_name(std::string(kPictureFolder))) continue;
    for (const std::string& value : option->results()) {
      if (IsOutput(*option)) {
        outputs.push_back({option->get_name(), value});
      } else {
        inputs.push_back(FileOf(value));
        // The path of a recording's description stands for its folder.
        const fs::path name = fs::path(inputs.back()).filename();
        const bool describes = name == "recording.json" || name == "scene.json";
        if (option->get_positional() && describes) {
          inputs.push_back((fs::path(inputs.back()).parent_path() / ".").string());
        }
      }
    }
  }
  std::set<fs::path> named;
  for (const NamedOutput& output : outputs) {
    PLEINAIR_RETURN_IF_ERROR(files::CheckNamedOutput(output.option, output.file, inputs));
    std::error_code error;
    const fs::path file = fs::weakly_canonical(output.file, error);
    if (!error && !fs::is_other(fs::status(file, error)) && !named.insert(file).second) {
      return InputError(output.file, "is named twice, by " + output.option + " too",
                        "give each output a name of its own");
    }
  }
  for (const CLI::App* chosen : command.get_subcommands()) {
    PLEINAIR_RETURN_IF_ERROR(CheckOptionsOf(*chosen));
  }
  return {};
}

}  // namespace

Result<void> CheckOutputOptions(const CLI::App& program) { return CheckOptionsOf(program); }

}  // namespace pleinair::app
