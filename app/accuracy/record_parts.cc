#include "app/accuracy/record_parts.h"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <sstream>

#include "app/accuracy/record_fields.h"
#include "app/accuracy/record_json.h"
#include "app/output/earlier_replay.h"
#include "base/atomic_file.h"
#include "files/output_rule.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;
using Json = RecordJsonValue;

constexpr int kFormat = 1;
// Ten times the number of chunks of all sweeps at the largest --scale.
constexpr std::int64_t kMostChunks = 1'000'000;

/// Header before a part's records.
struct PartHead {
  std::int64_t chunk = 0;
  std::size_t records = 0, pictures = 0;
  std::string skipped, machine;
};

/// The configuration follows. The head is const when it is written.
template <typename Visitor, typename Head>
void TellHead(Visitor& visit, Head& head) {
  visit.Field("chunk", head.chunk);
  visit.Field("records", head.records);
  visit.Field("pictures", head.pictures);
  visit.Field("skipped", head.skipped);
  visit.Field("machine", head.machine);
}

/// Reads the file's bytes; nothing if it cannot be read.
std::optional<std::string> ReadAll(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;  // Reading a folder throws.
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

std::string RunJson(const std::string& config_json, std::int64_t chunks) {
  return fmt::format(
      "{{\"program\":\"pleinair\",\"version\":\"{}\",\"format\":{},\"chunks\":{},\"config\":{}}}\n",
      PLEINAIR_VERSION, kFormat, chunks, config_json);
}

}  // namespace

Result<RecordParts> RecordParts::Open(const fs::path& folder, const AccuracyConfig& config,
                                      std::int64_t chunks) {
  RecordParts parts;
  parts.folder_ = folder;
  parts.config_ = config;
  parts.config_json_ = ConfigJson(config);
  parts.chunks_ = chunks;
  PLEINAIR_RETURN_IF_ERROR(parts.ClaimFolder(folder));
  std::error_code error;
  fs::create_directories(folder / "parts", error);
  if (error) return tl::make_unexpected(WriteError(folder, error.value()));
  return parts;
}

Result<void> RecordParts::ClaimFolder(const fs::path& folder) const {
  PLEINAIR_RETURN_IF_ERROR(CheckIsNoRecording(folder));
  const std::string run = RunJson(config_json_, chunks_);
  // Without run.json, files of these names are the user's. They are listed first: another shard may
  // write both meanwhile, run.json before the others. An empty folder of parts loses nothing.
  Result<void> free;
  std::error_code error;
  for (const char* name : {"records.jsonl", "pictures.jsonl", "times.json", "times.html",
                           "report.html", "report.json", "parts"}) {
    const fs::path file = folder / name;
    if (fs::is_directory(file, error) && fs::is_empty(file, error)) continue;
    if (free) free = files::CheckFreeName(file);
  }
  if (const auto there = ReadAll(folder / "run.json")) {
    if (*there == run) return {};
    return InputError(folder.string(), "holds an accuracy run of another configuration or version",
                      "choose another folder with -o, or remove it");
  }
  if (!free) return free;
  fs::create_directories(folder, error);
  if (error) return tl::make_unexpected(WriteError(folder, error.value()));
  return WriteFileAtomically(folder / "run.json", run);
}

Result<RecordParts> RecordParts::Read(const fs::path& folder) {
  const fs::path run_file = folder / "run.json";
  const auto text = ReadAll(run_file);
  if (!text) {
    return InputError(run_file.string(), "there is no accuracy run",
                      "name a folder that 'pleinair accuracy -o' wrote");
  }
  const Json json = ParseRecordJson(*text);
  const bool is_run = json.is_object() && json.contains("config") && json.contains("format") &&
                      json["format"] == kFormat && json.contains("chunks") &&
                      json["chunks"].is_number_integer() && json["chunks"] >= 0 &&
                      json["chunks"] <= kMostChunks;
  if (!is_run) {
    return InputError(run_file.string(), "is no run of this format",
                      "name a folder that 'pleinair accuracy -o' wrote");
  }
  RecordParts parts;
  parts.folder_ = folder;
  parts.config_json_ = json["config"].dump();
  parts.chunks_ = json["chunks"].get<std::int64_t>();
  PLEINAIR_ASSIGN_OR_RETURN(parts.config_, ParseConfig(parts.config_json_, run_file.string()));
  return parts;
}

fs::path RecordParts::FileOf(std::int64_t chunk) const {
  return folder_ / "parts" / fmt::format("{:05}.jsonl", chunk);
}

bool RecordParts::Has(std::int64_t chunk) const {
  const auto part = Load(chunk);
  return part && *part && (*part)->skipped.empty();
}

Result<void> RecordParts::Write(const RecordPart& part) const {
  const PartHead head{part.chunk, part.records.size(), part.pictures.size(), part.skipped,
                      part.machine};
  FieldWriter writer;
  TellHead(writer, head);
  writer.json["config"] = Json::parse(config_json_);
  std::string text = LineOf(writer.json) + "\n";
  for (const accuracy::FrameRecord& record : part.records) {
    text += RecordJson(record, true) + "\n";
  }
  for (const LightPicture& picture : part.pictures) {
    const Json jpegs{picture.truth, picture.composed, picture.difference};
    text += PictureJson(picture.record) + "\n" + jpegs.dump() + "\n";
  }
  return WriteFileAtomically(FileOf(part.chunk), text);
}

Result<std::optional<RecordPart>> RecordParts::Load(std::int64_t chunk) const {
  const auto text = ReadAll(FileOf(chunk));
  if (!text || text->empty() || text->back() != '\n') return std::nullopt;
  std::istringstream lines(*text);
  std::string line;
  std::getline(lines, line);
  std::string config;
  const auto head =
      ReadJson<PartHead>(line, InputError(FileOf(chunk).string(), "is no part of a run"),
                         [&config](const Json& json, PartHead* read) {
                           FieldReader reader(json);
                           TellHead(reader, *read);
                           config = json.at("config").dump();
                         });
  if (!head) return std::nullopt;
  if (config != config_json_ || head->chunk != chunk) {
    return InputError(FileOf(chunk).string(), "belongs to a run of another configuration",
                      "remove it and run again");
  }
  RecordPart part;
  part.chunk = chunk;
  part.skipped = head->skipped;
  part.machine = head->machine;
  while (part.records.size() < head->records && std::getline(lines, line)) {
    auto record = ParseRecord(line, FileOf(chunk).string());
    if (!record) return std::nullopt;
    part.records.push_back(*std::move(record));
  }
  while (std::getline(lines, line)) {
    auto record = ParsePicture(line, FileOf(chunk).string());
    if (!record || !std::getline(lines, line)) return std::nullopt;
    const Json jpegs = ParseRecordJson(line);
    const bool is_three = jpegs.is_array() && jpegs.size() == 3 && jpegs[0].is_string() &&
                          jpegs[1].is_string() && jpegs[2].is_string();
    if (!is_three) return std::nullopt;
    part.pictures.push_back({*std::move(record), jpegs[0], jpegs[1], jpegs[2]});
  }
  const bool whole = part.records.size() == head->records && part.pictures.size() == head->pictures;
  return whole ? std::optional(std::move(part)) : std::nullopt;
}

}  // namespace pleinair::app
