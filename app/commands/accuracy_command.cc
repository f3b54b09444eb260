#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "accuracy/sweeps.h"
#include "app/accuracy/accuracy_config.h"
#include "app/accuracy/accuracy_report.h"
#include "app/accuracy/accuracy_run.h"
#include "app/commands/command.h"
#include "app/options/marker_numbers.h"
#include "app/options/number_range.h"
#include "app/options/shard_option.h"

namespace pleinair::app {
namespace {

constexpr const char* kAccuracyExamples =
    "Examples:\n"
    "  pleinair accuracy --quick -o out/quick\n"
    "  pleinair accuracy --sweep distance,angle --against apriltag,aruco -o out/far\n"
    "  pleinair accuracy recordings/* -o out/films\n"
    "  pleinair accuracy --shard 2/7 -o out/full        (and 'pleinair report merge out/full')\n"
    "  pleinair report diff out/before out/after\n"
    "DIR gets report.html, report.json and records.jsonl, which depend on the options above "
    "alone,\n"
    "and times.json (docs/guide/accuracy-runs.md). A run that was interrupted goes on where it\n"
    "stopped. Markers are S-G 0-49, 14 cm; each peer has its own marker in the same scenes.";

struct AccuracyOptions {
  AccuracyConfig config;
  std::vector<std::string> sweeps;
  std::string shard, output;
  std::optional<std::uint64_t> noise_seed;
  int threads = 0;
  bool quick = false, json = false;
};

Result<void> Complete(AccuracyOptions* options) {
  constexpr double kQuickScale = 0.125;
  AccuracyConfig& config = options->config;
  if (options->quick) config.scale = kQuickScale;
  PLEINAIR_RETURN_IF_ERROR(MarkerNumbersOf(config.numbers));
  config.noise_seed = options->noise_seed.value_or(config.seed);
  const bool all = options->sweeps == std::vector<std::string>{"all"} ||
                   (options->sweeps.empty() && config.recordings.empty());
  for (const std::string& name : accuracy::SweepNames()) {
    const bool chosen =
        std::find(options->sweeps.begin(), options->sweeps.end(), name) != options->sweeps.end();
    if (all || chosen) config.sweeps.push_back(name);
  }
  return {};
}

Result<void> RunAccuracy(AccuracyOptions& options) {
  PLEINAIR_RETURN_IF_ERROR(Complete(&options));
  PLEINAIR_ASSIGN_OR_RETURN(const Shard shard, ParseShard(options.shard));
  const auto chunks = static_cast<std::int64_t>(PlanChunks(options.config).size());
  PLEINAIR_ASSIGN_OR_RETURN(const RecordParts parts,
                            RecordParts::Open(options.output, options.config, chunks));
  const int threads = options.threads > 0
                          ? options.threads
                          : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  PLEINAIR_ASSIGN_OR_RETURN(const RunOutcome outcome, MeasureShard(parts, shard, threads));
  nlohmann::ordered_json json{{"folder", options.output},
                              {"shard", fmt::format("{}/{}", shard.index, shard.count)},
                              {"parts", outcome.chunks},
                              {"measured_now", outcome.measured},
                              {"skipped", outcome.skipped}};
  std::string text = fmt::format("{} of {} parts measured now", outcome.measured, outcome.chunks);
  if (shard.count == 1) {
    PLEINAIR_ASSIGN_OR_RETURN(const WrittenReport written,
                              WriteAccuracyReport({parts}, options.output));
    json["frames"] = written.frames;
    json["report"] = options.output + "/report.html";
    text += fmt::format(", {} frames: {}/report.html", written.frames, options.output);
  }
  std::cout << (options.json
                    ? json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
                    : text)
            << '\n';
  for (const std::string& message : outcome.skipped) {
    std::cerr << "pleinair accuracy: skipped " << message << '\n';
  }
  if (outcome.skipped.empty()) return {};
  return tl::make_unexpected(
      Error{outcome.skipped_kind, options.output,
            fmt::format("{} of {} recordings could not be measured",
                        outcome.skipped_recordings.size(), options.config.recordings.size()),
            "correct what the lines above report and run again: finished parts are kept"});
}

}  // namespace

void AddAccuracyCommand(CLI::App& app, CommandResult& result) {
  auto options = std::make_shared<AccuracyOptions>();
  CLI::App* command = app.add_subcommand(
      "accuracy", "Measure detection, pose and covariance against exact truth, with uncertainty");
  command->footer(kAccuracyExamples);
  command->add_option("RECORDING", options->config.recordings,
                      "Recordings with ground truth (truth.tum, groundtruth.txt, or EuRoC's)");
  command->add_flag("!--no-light", options->config.light,
                    "Do not compose recordings that have ground-truth images");
  std::vector<std::string> sweeps = accuracy::SweepNames();
  sweeps.push_back("all");
  command
      ->add_option("--sweep", options->sweeps,
                   "Built-in scenes; all where neither these nor recordings are named")
      ->delimiter(',')
      ->check(CLI::IsMember(sweeps))
      ->type_name("NAME,...");
  command->add_option("--against", options->config.peers, "Peers on the same scenes")
      ->delimiter(',')
      ->check(CLI::IsMember({"apriltag", "aruco"}))
      ->type_name("apriltag,aruco");
  command->add_option("-o,--output", options->output, "Folder for the report")
      ->required()
      ->type_name("DIR");
  command->add_option("--size", options->config.camera, "Lens and image size")
      ->check(CLI::IsMember(accuracy::SweepCameraNames()))
      ->capture_default_str();
  command->add_option("--seed", options->config.seed, "Random seed of the scenes")
      ->capture_default_str();
  command->add_option("--noise-seed", options->noise_seed,
                      "Random seed of the noise on the same scenes (default: as --seed)");
  command
      ->add_option(
          "--numbers", options->config.numbers,
          "S-G numbers assumed to be in use in the sweeps, such as 0-49 (default: all 4,096)")
      ->delimiter(',')
      ->type_name("N,...");
  CLI::Option* scale = command
                           ->add_option("--scale", options->config.scale,
                                        "Factor on the number of frames of each level")
                           ->check(NumberRange(kMinScale, kMaxScale))
                           ->capture_default_str();
  command->add_flag("--quick", options->quick, "An eighth of the frames")->excludes(scale);
  command
      ->add_option(
          "--measure", options->config.measure,
          "How markers are measured: blocks (as in detect and live) or print (as in replay)")
      ->check(CLI::IsMember({"blocks", "print"}))
      ->capture_default_str();
  command
      ->add_option(
          "--spoil-corners-px", options->config.spoil_corners_px,
          "Move each found corner by this distance: a planted regression that tests 'report diff'")
      ->check(NumberRange(0.0, kMostSpoil_px));
  command->add_option("--shard", options->shard, "Do the I-th of N parts only; merge them later")
      ->type_name("I/N");
  command
      ->add_option("--threads", options->threads,
                   "Number of threads; default: as many as the machine has")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--json", options->json, "One JSON object on standard output");
  command->callback([options, &result] { result.status = RunAccuracy(*options); });
}

}  // namespace pleinair::app
