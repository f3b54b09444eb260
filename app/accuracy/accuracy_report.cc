#include "app/accuracy/accuracy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "accuracy/sweeps.h"
#include "app/accuracy/accuracy_html.h"
#include "app/accuracy/accuracy_json.h"
#include "app/accuracy/record_json.h"
#include "app/stage_times.h"
#include "base/atomic_file.h"

namespace pleinair::app {
namespace {

using Json = nlohmann::ordered_json;

/// "3", "3, 5 and 7", "3, 5, 7 and 12 more".
std::string ListOf(const std::vector<std::int64_t>& numbers) {
  constexpr std::size_t kMost = 6;
  const std::size_t shown = std::min(numbers.size(), kMost);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i)
    text += fmt::format("{}{}", i > 0 ? ", " : "", numbers[i]);
  if (shown < numbers.size()) text += fmt::format(" and {} more", numbers.size() - shown);
  return text;
}

struct Gathered {
  std::vector<accuracy::FrameRecord> records;
  std::vector<std::string> skipped;
  std::set<std::string> machines;
};

Result<Gathered> Gather(const std::vector<RecordParts>& folders) {
  Gathered gathered;
  std::vector<std::int64_t> missing;
  for (std::int64_t chunk = 0; chunk < folders[0].chunks(); ++chunk) {
    std::optional<RecordPart> best;
    for (const RecordParts& folder : folders) {
      PLEINAIR_ASSIGN_OR_RETURN(std::optional<RecordPart> part, folder.Load(chunk));
      // One that was measured counts before one that had to be skipped.
      if (part && (!best || (!best->skipped.empty() && part->skipped.empty()))) {
        best = std::move(part);
      }
    }
    if (!best) {
      missing.push_back(chunk);
      continue;
    }
    if (!best->skipped.empty()) gathered.skipped.push_back(best->skipped);
    gathered.machines.insert(best->machine);
    for (accuracy::FrameRecord& record : best->records) {
      gathered.records.push_back(std::move(record));
    }
  }
  if (!missing.empty()) {
    return SystemError(folders[0].folder().string(),
                       fmt::format("{} of {} parts are not there (of frames of part {})",
                                   missing.size(), folders[0].chunks(), ListOf(missing)),
                       "run the shards that are missing; they go on where they stopped");
  }
  return gathered;
}

std::string TimesJson(const Gathered& gathered) {
  Json json;
  json["machines"] = gathered.machines;
  std::map<std::string, StageTimes> detectors;
  for (const accuracy::FrameRecord& record : gathered.records) {
    for (const auto& [stage, ms] : record.stages_ms) detectors[record.detector].Add(stage, ms);
  }
  json["stages"] = Json::array();
  for (const auto& [detector, times] : detectors) {
    for (const StageTimes::Summary& stage : times.Summarize()) {
      json["stages"].push_back({{"detector", detector},
                                {"stage", stage.stage},
                                {"frames", stage.runs},
                                {"median_ms", stage.median_ms},
                                {"p95_ms", stage.p95_ms}});
    }
  }
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

Result<WrittenReport> WriteAccuracyReport(const std::vector<RecordParts>& folders,
                                          const std::filesystem::path& output) {
  for (const RecordParts& folder : folders) {
    if (folder.config() == folders[0].config() && folder.chunks() == folders[0].chunks()) continue;
    return InputError(folder.folder().string(),
                      "is of another run than " + folders[0].folder().string(),
                      "merge the shards of one command");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const Gathered gathered, Gather(folders));
  AccuracyReport report{.config = folders[0].config(),
                        .version = PLEINAIR_VERSION,
                        .summary = {},
                        .skipped = gathered.skipped};
  const CameraModel camera = accuracy::SweepCamera(report.config.camera);
  report.summary = accuracy::Summarize(gathered.records, camera.width, camera.height);
  std::string lines;
  std::set<std::int64_t> frames;
  for (const accuracy::FrameRecord& record : gathered.records) {
    lines += RecordJson(record, false) + "\n";
    frames.insert(record.frame);
  }
  std::error_code error;
  std::filesystem::create_directories(output, error);
  if (error) return tl::make_unexpected(WriteError(output, error.value()));
  PLEINAIR_RETURN_IF_ERROR(folders[0].WriteRunFile(output));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(output / "records.jsonl", lines));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(output / "times.json", TimesJson(gathered)));
  PLEINAIR_RETURN_IF_ERROR(
      WriteFileAtomically(output / "report.html", AccuracyHtml(report, gathered.records)));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(output / "report.json", AccuracyJson(report)));
  return WrittenReport{static_cast<std::int64_t>(frames.size()), gathered.skipped};
}

}  // namespace pleinair::app
