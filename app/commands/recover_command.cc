#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/options/option_use.h"
#include "app/output/output_folder.h"
#include "app/terminal/interrupt.h"
#include "app/terminal/interrupt_deadline.h"
#include "base/atomic_file.h"
#include "devices/recordings/frame_pack.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecoverExamples =
    "Examples:\n"
    "  pleinair recover walk -o walk_clean\n"
    "Copies a live recording with the whole frames of its frames.pack. What is lost is printed. "
    "The\n"
    "recording stays as it is. Frames keep their bytes and time stamps.";

constexpr const char* kPackName = "frames.pack";

struct RecoverArguments {
  std::string recording, output;
  bool json = false;
};

Result<void> CheckRecoverArguments(const RecoverArguments& arguments) {
  std::error_code error;
  const fs::path pack = fs::path(arguments.recording) / kPackName;
  if (!fs::is_regular_file(pack, error)) {
    return InputError(arguments.recording, "holds no frames.pack",
                      "name the folder that 'pleinair live --record' wrote");
  }
  if (fs::exists(arguments.output, error) && !fs::is_empty(arguments.output, error)) {
    return InputError(arguments.output, "is there already and is not empty",
                      "name a new folder with -o");
  }
  const fs::path from = fs::weakly_canonical(arguments.recording, error);
  const fs::path to = fs::weakly_canonical(arguments.output, error);
  if (std::mismatch(from.begin(), from.end(), to.begin(), to.end()).first == from.end()) {
    return InputError(arguments.output, "lies inside the recording",
                      "name a folder outside of it with -o");
  }
  return {};
}

/// Copies the recording's other files: its description, its scene and their models.
Result<void> CopyOtherFiles(const fs::path& from, const fs::path& to) {
  std::error_code error;
  for (fs::directory_iterator it(from, error), end; !error && it != end; it.increment(error)) {
    const fs::path name = it->path().filename();
    if (name == kPackName || name.string().starts_with('.')) continue;
    std::error_code failed;
    fs::copy(it->path(), to / name, fs::copy_options::recursive, failed);
    if (failed) return tl::make_unexpected(WriteError(to / name, failed.value()));
  }
  if (error) return InputError(from.string(), "cannot be read: " + error.message());
  return {};
}

Result<void> RunRecover(const RecoverArguments& arguments) {
  PLEINAIR_RETURN_IF_ERROR(CheckRecoverArguments(arguments));
  const InterruptGuard guard;
  PLEINAIR_ASSIGN_OR_RETURN(OutputFolder folder, OutputFolder::Create(arguments.output));
  std::optional<InterruptDeadline> deadline(std::in_place, arguments.recording, folder.CleanUp());
  const fs::path from(arguments.recording);
  const auto recovered =
      devices::RecoverFramePack(from / kPackName, folder.staging() / kPackName,
                                [&] { return CheckInterrupt(arguments.recording); });
  if (!recovered) return tl::make_unexpected(folder.InTermsOfTarget(recovered.error()));
  if (auto copied = CopyOtherFiles(from, folder.staging()); !copied) {
    return tl::make_unexpected(folder.InTermsOfTarget(copied.error()));
  }
  PLEINAIR_RETURN_IF_ERROR(CheckInterrupt(arguments.recording));
  deadline.reset();  // The files appear together: all or none.
  PLEINAIR_RETURN_IF_ERROR(folder.Commit());
  if (arguments.json) {
    const nlohmann::ordered_json json{
        {"folder", arguments.output}, {"frames", recovered->frames}, {"lost", recovered->damage}};
    std::cout << json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    return {};
  }
  for (const std::string& lost : recovered->damage) std::cerr << lost << '\n';
  std::cerr << recovered->frames << " whole frames in " << arguments.output << '\n';
  return {};
}

}  // namespace

void AddRecoverCommand(CLI::App& app, CommandResult& result) {
  auto arguments = std::make_shared<RecoverArguments>();
  CLI::App* command =
      app.add_subcommand("recover", "Copy what is whole of a damaged live recording");
  command->footer(kRecoverExamples);
  command->add_option("RECORDING", arguments->recording, "Folder of a live recording")->required();
  command->add_option("-o,--output", arguments->output, "New folder")->required();
  command->add_flag("--json", arguments->json, "One JSON object on standard output");
  RefuseEmptyValues(*command);
  command->callback([arguments, &result] { result.status = RunRecover(*arguments); });
}

}  // namespace pleinair::app
