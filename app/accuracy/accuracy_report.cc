#include "app/accuracy/accuracy_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "accuracy/sweeps.h"
#include "app/accuracy/accuracy_html.h"
#include "app/accuracy/accuracy_json.h"
#include "app/accuracy/record_json.h"
#include "app/accuracy/run_times.h"
#include "base/atomic_file.h"

namespace pleinair::app {
namespace {

/// "3", "3, 5 and 7", "3, 5, 7 and 12 more".
std::string ListOf(const std::vector<std::int64_t>& numbers) {
  constexpr std::size_t kMax = 6;
  const std::size_t shown = std::min(numbers.size(), kMax);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i)
    text += fmt::format("{}{}", i > 0 ? ", " : "", numbers[i]);
  if (shown < numbers.size()) text += fmt::format(" and {} more", numbers.size() - shown);
  return text;
}

struct Gathered {
  accuracy::RunRecords records;
  std::vector<LightPicture> pictures;
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
      // A measured part takes precedence over a skipped one.
      if (part && (!best || (!best->skipped.empty() && part->skipped.empty()))) {
        best = std::move(part);
      }
    }
    if (!best) {
      missing.push_back(chunk);
      continue;
    }
    // Both parts of a recording may fail for the same reason.
    const bool is_new = std::find(gathered.skipped.begin(), gathered.skipped.end(),
                                  best->skipped) == gathered.skipped.end();
    if (!best->skipped.empty() && is_new) gathered.skipped.push_back(best->skipped);
    gathered.machines.insert(best->machine);
    for (accuracy::FrameRecord& record : best->records) {
      gathered.records.frames.push_back(std::move(record));
    }
    for (LightPicture& picture : best->pictures) {
      gathered.records.pictures.push_back(picture.record);
      gathered.pictures.push_back(std::move(picture));
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

}  // namespace

Result<WrittenReport> WriteAccuracyReport(const std::vector<RecordParts>& folders,
                                          const std::filesystem::path& output) {
  for (const RecordParts& folder : folders) {
    if (folder.config() == folders[0].config() && folder.chunks() == folders[0].chunks()) continue;
    return InputError(folder.folder().string(),
                      "is of another run than " + folders[0].folder().string(),
                      "merge the shards of one command");
  }
  PLEINAIR_ASSIGN_OR_RETURN(Gathered gathered, Gather(folders));
  AccuracyReport report{.config = folders[0].config(),
                        .version = PLEINAIR_VERSION,
                        .machines = gathered.machines,
                        .summary = {},
                        .pictures = std::move(gathered.pictures),
                        .skipped = gathered.skipped};
  const CameraModel camera = accuracy::SweepCamera(report.config.camera);
  report.summary = accuracy::Summarize(gathered.records, camera.width, camera.height);
  std::string lines, picture_lines;
  std::set<std::int64_t> frames;
  for (const accuracy::FrameRecord& record : gathered.records.frames) {
    lines += RecordJson(record, false) + "\n";
    frames.insert(record.frame);
  }
  for (const accuracy::ImageRecord& picture : gathered.records.pictures) {
    picture_lines += PictureJson(picture) + "\n";
  }
  PLEINAIR_RETURN_IF_ERROR(folders[0].ClaimFolder(output));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(output / "records.jsonl", lines));
  if (!picture_lines.empty()) {
    PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(output / "pictures.jsonl", picture_lines));
  }
  const std::vector<DetectorTimes> times = TimesOf(gathered.records.frames);
  PLEINAIR_RETURN_IF_ERROR(
      WriteFileAtomically(output / "times.json", TimesJson(gathered.machines, times)));
  PLEINAIR_RETURN_IF_ERROR(
      WriteFileAtomically(output / "times.html", TimesHtml(gathered.machines, times)));
  PLEINAIR_RETURN_IF_ERROR(
      WriteFileAtomically(output / "report.html", AccuracyHtml(report, gathered.records.frames)));
  PLEINAIR_RETURN_IF_ERROR(WriteFileAtomically(output / "report.json", AccuracyJson(report)));
  return WrittenReport{static_cast<std::int64_t>(frames.size()), gathered.skipped};
}

}  // namespace pleinair::app
