#include "app/output/earlier_replay.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "export/trajectories/colmap_folder.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kFramesPattern = "frames/%04d.png";

/// Returns the number of "0012.png", as replay writes it.
std::optional<std::int64_t> FrameNumber(const fs::path& name) {
  const std::string stem = name.stem().string();
  std::int64_t number = -1;
  const auto parsed = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  const bool is_number = parsed.ec == std::errc() && parsed.ptr == stem.data() + stem.size();
  if (name.extension() != ".png" || stem.size() < 4 || !is_number || number < 0) return {};
  return number;
}

/// True for the names of a replay's outputs.
bool IsNamedLikeOutput(const fs::path& relative) {
  const std::string folder = relative.parent_path().string();
  const std::string name = relative.filename().string();
  if (folder.empty()) {
    return name == "composite.mp4" || name == "detections.jsonl" || name == "light.csv" ||
           name == "report.json" || name == "report.html" || name == "camera.glb" ||
           name == "camera.mcap" || name == "camera_from_film.json" ||
           name == "camera_from_trajectory.json" || name == "timelapse.mp4" ||
           name == "timelapse.png";
  }
  if (folder == "poses") return relative.extension() == ".tum" || relative.extension() == ".csv";
  if (folder == "colmap") {
    const auto is_named = [&](exports::ColmapForm form) {
      const auto names = exports::ColmapFileNames(form);
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    return is_named(exports::ColmapForm::kText) || is_named(exports::ColmapForm::kBinary);
  }
  return (folder == "frames" || folder == "timelapse") && FrameNumber(relative.filename());
}

bool IsPicture(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

bool HoldsPictures(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (IsPicture(it->path())) return true;
  }
  return false;
}

}  // namespace

EarlierReplay EarlierReplay::In(const fs::path& folder) {
  EarlierReplay earlier;
  earlier.folder_ = folder;
  std::error_code error;
  if (!fs::is_regular_file(folder / "report.json", error)) return earlier;
  std::ifstream in(folder / "report.json", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const Json report = Json::parse(text, nullptr, false);
  const auto has = [&](const char* key) { return report.is_object() && report.contains(key); };
  if (!has("program") || report["program"] != "pleinair") return earlier;
  if (!has("outputs") || !report["outputs"].is_array()) return earlier;
  for (const Json& output : report["outputs"]) {
    if (output.is_string()) earlier.outputs_.insert(output.get<std::string>());
  }
  if (earlier.outputs_.contains(kFramesPattern) && has("frames") &&
      report["frames"].is_number_integer()) {
    earlier.frames_.count = report["frames"].get<std::int64_t>();
    if (has("first_frame") && report["first_frame"].is_number_integer()) {
      earlier.frames_.first = report["first_frame"].get<std::int64_t>();
    }
  }
  return earlier;
}

bool EarlierReplay::Wrote(const fs::path& relative) const {
  if (outputs_.contains(relative.generic_string())) return true;
  if (relative.parent_path() != "frames") return false;
  const std::optional<std::int64_t> number = FrameNumber(relative.filename());
  return number && *number >= frames_.first && *number - frames_.first < frames_.count;
}

std::vector<fs::path> EarlierReplay::FilesNamedLikeOutputs() const {
  std::vector<fs::path> files;
  for (const char* part : {"", "poses", "frames", "timelapse", "colmap"}) {
    std::error_code error;
    for (fs::directory_iterator it(folder_ / part, error), end; !error && it != end;
         it.increment(error)) {
      const fs::path relative = fs::path(part) / it->path().filename();
      if (IsNamedLikeOutput(relative)) files.push_back(relative);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

Result<void> EarlierReplay::CheckNothingForeign() const {
  for (const fs::path& file : FilesNamedLikeOutputs()) {
    if (!Wrote(file)) return NotFromAReplay(folder_ / file);
  }
  return {};
}

void EarlierReplay::Remove() const {
  std::error_code ignored;
  for (const fs::path& file : FilesNamedLikeOutputs()) {
    if (Wrote(file) && file != "report.json") fs::remove(folder_ / file, ignored);
  }
  for (const char* part : {"poses", "frames", "timelapse", "colmap"}) {
    // Only if it is empty.
    if (!outputs_.empty() && fs::is_directory(folder_ / part, ignored)) {
      fs::remove(folder_ / part, ignored);
    }
  }
  // Last: after an interruption, the files are still known as a replay's.
  if (Wrote("report.json")) fs::remove(folder_ / "report.json", ignored);
}

tl::unexpected<Error> NotFromAReplay(const fs::path& file) {
  return InputError(file.string(), "was not written by a replay and will not be overwritten",
                    "name another folder with -o, or move the file away");
}

Result<void> CheckIsNoRecording(const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::canonical(folder, error);
  if (error) return {};
  const std::string remedy = "name another folder with -o";
  for (const char* mark : {"recording.json", "scene.json", "mav0", "cam0", "data.csv"}) {
    if (fs::exists(real / mark, error)) {
      return InputError(folder.string(), std::string("is a recording: it has a ") + mark, remedy);
    }
  }
  // A replay's output folder may be inside a recording's and contain images of the user.
  if (EarlierReplay::In(real).Wrote("report.json")) return {};
  for (const char* mark : {"recording.json", "scene.json", "data.csv"}) {
    if (fs::exists(real.parent_path() / mark, error) && HoldsPictures(real)) {
      return InputError(
          folder.string(),
          std::string("holds the frames of a recording: a ") + mark + " lies beside it", remedy);
    }
  }
  return {};
}

}  // namespace pleinair::app
