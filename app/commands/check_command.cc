#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/check/check_project.h"
#include "app/check/site_findings.h"
#include "app/commands/command.h"
#include "app/options/model_options.h"
#include "app/options/option_use.h"

namespace pleinair::app {
namespace {

constexpr const char* kCheckExamples =
    "Examples:\n"
    "  pleinair check site\n"
    "      is it worth going home? looks at 24 frames, or at 96 along a\n"
    "      trajectory, in seconds\n"
    "  pleinair check walk.mp4 --calibration phone.yaml --scene scene.toml --json\n"
    "Checks: is the marker seen, large, sharp and rightly exposed; does the lens stay the same "
    "and\n"
    "fit its calibration; is the sun up; do shadows agree with the heading; is the object in "
    "view; does a [trajectory] fit the film.\n"
    "A finding is good, doubtful (the picture may be wrong), bad (it will be) or not checked. "
    "Exit\n"
    "code 0: nothing is bad; 1: something is; 2: the project cannot be read.";

struct CheckArguments {
  std::string project, scene, calibration;
  bool json = false;
};

Result<void> RunCheck(const CheckArguments& arguments) {
  CheckRequest request{arguments.project, {}, {}};
  if (!arguments.scene.empty()) request.scene = arguments.scene;
  if (!arguments.calibration.empty()) request.calibration = arguments.calibration;
  PLEINAIR_ASSIGN_OR_RETURN(const SiteFacts facts, LookAtSite(request));
  std::string bad;
  for (const SiteFinding& finding : JudgeSite(facts)) {
    if (finding.verdict == SiteVerdict::kBad) {
      bad += (bad.empty() ? "" : ", ") + finding.subject;
    }
    if (arguments.json) {
      const nlohmann::ordered_json json{{"subject", finding.subject},
                                        {"verdict", VerdictText(finding.verdict)},
                                        {"text", finding.text},
                                        {"remedy", finding.remedy}};
      std::cout << json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
      continue;
    }
    std::cout << finding.subject << ": " << VerdictText(finding.verdict) << ": " << finding.text
              << '\n';
    if (!finding.remedy.empty()) std::cout << "    " << finding.remedy << '\n';
  }
  if (bad.empty()) return {};
  return SystemError(arguments.project, "gives no right picture as it is: " + bad,
                     "do what is written beside it");
}

}  // namespace

void AddCheckCommand(CLI::App& app, CommandResult& result) {
  CLI::App* command =
      app.add_subcommand("check", "Say what is wrong with a project before you leave the place");
  command->footer(kCheckExamples);
  auto arguments = std::make_shared<CheckArguments>();
  command
      ->add_option("PROJECT", arguments->project,
                   "Folder of a project or a recording, a film or a photograph")
      ->required();
  command->add_option("--scene", arguments->scene, "Scene instead of the project's own");
  command->add_option("--calibration", arguments->calibration,
                      "Calibration of the lens instead of the project's own");
  AddModelFileOptions(*command);
  command->add_flag("--json", arguments->json, "One JSON object for each finding");
  RefuseEmptyValues(*command);
  command->callback([arguments, &result] { result.status = RunCheck(*arguments); });
}

}  // namespace pleinair::app
