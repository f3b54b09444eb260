#include "app/accuracy/recorded_run.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "app/accuracy/record_json.h"
#include "app/accuracy/record_parts.h"

namespace pleinair::app {
namespace {

template <typename Record>
Result<void> ReadLines(std::istream& in, const std::filesystem::path& file,
                       Result<Record> (*parse)(std::string_view, const std::string&),
                       std::vector<Record>* records) {
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string where = fmt::format("{}:{}", file.string(), ++number);
    PLEINAIR_ASSIGN_OR_RETURN(Record record, parse(line, where));
    records->push_back(std::move(record));
  }
  return {};
}

}  // namespace

Result<RecordedRun> ReadRecordedRun(const std::string& folder) {
  std::filesystem::path path = folder;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) path = path.parent_path();
  PLEINAIR_ASSIGN_OR_RETURN(const RecordParts parts, RecordParts::Read(path));
  RecordedRun run{parts.config(), {}};
  const std::filesystem::path file = path / "records.jsonl";
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    return InputError(file.string(), "cannot be opened",
                      "finish the run, or put its shards together with 'pleinair report merge'");
  }
  PLEINAIR_RETURN_IF_ERROR(ReadLines(in, file, ParseRecord, &run.records.frames));
  // Runs without ground-truth images do not have this file.
  const std::filesystem::path pictures = path / "pictures.jsonl";
  std::ifstream in_pictures(pictures, std::ios::binary);
  PLEINAIR_RETURN_IF_ERROR(ReadLines(in_pictures, pictures, ParsePicture, &run.records.pictures));
  return run;
}

}  // namespace pleinair::app
