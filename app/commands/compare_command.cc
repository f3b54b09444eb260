#include <fmt/format.h>

#include <cmath>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/command.h"
#include "app/compare/compare_html.h"
#include "app/compare/ground_truth_images.h"
#include "app/compare/image_comparison.h"
#include "app/compare/image_scores.h"
#include "app/replay/time_lapse/time_lapse.h"
#include "app/terminal/progress_bar.h"
#include "base/atomic_file.h"

namespace pleinair::app {
namespace {

constexpr const char* kCompareExamples =
    "Examples:\n"
    "  pleinair replay recordings/courtyard_midday -o out/demo --frames\n"
    "  pleinair compare out/demo recordings/courtyard_midday --report out/compare.html\n"
    "  pleinair compare ours/ truth/ --json\n"
    "DIR: what replay --frames wrote, or a folder of NNNN.png. TRUTH: a recording whose "
    "scene.json\n"
    "lists key_frames with ground-truth images and regions, or a folder of NNNN.png. Prints a "
    "line\n"
    "per image: PSNR (dB), SSIM, and mean CIEDE2000 over the object, its shadow, both with 25 "
    "pixels\n"
    "around them, and everything.";

constexpr int kReportWidth_px = 640;

struct CompareOptions {
  std::string pictures, truth, report;
  bool glossy = false, json = false;
};

nlohmann::ordered_json ScoresJson(const PictureScores& scores) {
  nlohmann::ordered_json json;
  const auto values = scores.Values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    json[kPictureScoreNames[i]] =
        std::isnan(values[i]) ? nlohmann::ordered_json() : nlohmann::ordered_json(values[i]);
  }
  return json;
}

void PrintRow(const std::string& name, const PictureScores& scores) {
  std::cout << fmt::format("{:<8}", name);
  for (const double value : scores.Values()) {
    std::cout << (std::isnan(value) ? fmt::format("{:>11}", "-") : fmt::format("{:11.3f}", value));
  }
  std::cout << '\n';
}

void PrintComparison(const CompareOptions& options, const Comparison& comparison) {
  if (options.json) {
    nlohmann::ordered_json json;
    for (const ComparedPicture& picture : comparison.compared) {
      json["pictures"][picture.name] = ScoresJson(picture.scores);
    }
    json["mean"] = ScoresJson(comparison.mean);
    std::cout << json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    return;
  }
  std::cout << fmt::format("{:<8}", "picture");
  for (const char* name : kPictureScoreNames) std::cout << fmt::format("{:>11}", name);
  std::cout << '\n';
  for (const ComparedPicture& picture : comparison.compared) {
    PrintRow(picture.name, picture.scores);
  }
  PrintRow("mean", comparison.mean);
}

Result<void> RunCompare(const CompareOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(const auto truths,
                            FindGroundTruthImages(options.truth, options.glossy));
  Comparison comparison;
  comparison.command = "pleinair compare " + options.pictures + " " + options.truth;
  if (options.glossy) comparison.command += " --glossy";
  comparison.pictures = options.pictures;
  comparison.truth = options.truth;
  std::vector<PictureScores> scores;
  const int width_px = options.report.empty() ? 0 : kReportWidth_px;
  {
    ProgressBar bar("Comparing", static_cast<std::int64_t>(truths.size()), "pictures");
    for (const GroundTruthImage& truth : truths) {
      PLEINAIR_ASSIGN_OR_RETURN(ComparedPicture compared,
                                ComparePicture(options.pictures, truth, width_px));
      scores.push_back(compared.scores);
      comparison.compared.push_back(std::move(compared));
      bar.Advance();
    }
  }
  comparison.mean = MeanOf(scores.data(), scores.size());
  if (!options.report.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(comparison.time_lapse, TimeLapseHtml(options.pictures));
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(options.report, CompareHtml(comparison)));
  }
  PrintComparison(options, comparison);
  return {};
}

}  // namespace

void AddCompareCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command =
      app.add_subcommand("compare", "Score composed images against ground-truth images");
  command->footer(kCompareExamples);
  command->add_option("DIR", options->pictures, "Folder with the composed images")->required();
  command
      ->add_option("TRUTH", options->truth,
                   "Recording with ground-truth images, or a folder of them")
      ->required();
  command->add_option("--report", options->report,
                      "Page with scores, truth, composed image and difference, and the day of "
                      "replay --time-lapse (HTML)");
  command->add_flag("--glossy", options->glossy, "Against the glossy variant of the object");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->callback([options, &result] {
    try {
      result.status = RunCompare(*options);
    } catch (const std::bad_alloc&) {
      result.status = SystemError("", "needs more memory than there is",
                                  "use fewer or smaller images, or a machine with more");
    } catch (const std::exception& error) {
      result.status = SystemError("", std::string("compare failed: ") + error.what(),
                                  "please report it with the images");
    }
  });
}

}  // namespace pleinair::app
