#include "tests/e2e/run_program.h"
#include "tests/source_tree.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;

std::string Quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

RunResult RunCommandLine(const std::vector<std::string>& arguments, const std::string& prefix) {
  const TemporaryFolder capture;
  std::string command = prefix + " ";
  for (const std::string& argument : arguments) command += Quoted(argument) + " ";
  // The redirections are outside, so that a prefix's limits do not apply to them.
  command = "{ " + command + "; } >" + Quoted(capture / "out") + " 2>" + Quoted(capture / "err");
  const int status = std::system(command.c_str());
  RunResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.out = ReadFile(capture / "out");
  result.err = ReadFile(capture / "err");
  return result;
}

std::string PleinairProgram() {
  const char* const other = std::getenv("PLEINAIR_PROGRAM");
  return other != nullptr ? other : PLEINAIR_PROGRAM;
}

RunResult RunPleinair(std::vector<std::string> arguments, const std::string& prefix) {
  arguments.insert(arguments.begin(), PleinairProgram());
  return RunCommandLine(arguments, prefix);
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "pleinair-e2e-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string ReadFile(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void WriteFile(const fs::path& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

std::vector<std::string> Listing(const fs::path& folder) {
  std::vector<std::string> names;
  if (!fs::exists(folder)) return names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    names.push_back(fs::relative(entry.path(), folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path BundledRecording() { return tests::SourceTree() / "recordings" / "courtyard_midday"; }

void MakeShortRecording(const fs::path& folder, int frames, bool with_object) {
  fs::create_directories(folder / "frames");
  for (const char* name : {"phantom.obj", "phantom.mtl", "object.obj", "object.mtl"}) {
    fs::copy_file(BundledRecording() / name, folder / name);
  }
  std::string stamps;
  for (int i = 0; i < frames; ++i) {
    const std::string name = fmt::format("frames/{:04}.jpg", i);
    fs::copy_file(BundledRecording() / name, folder / name);
    stamps += fmt::format("{}{:.6f}", i == 0 ? "" : ", ", i / 15.0);
  }
  WriteFile(
      folder / "recording.json",
      fmt::format(R"({{"format": 1, "frames": "frames", "frame_count": {}, "frame_rate_hz": 15,
 "timestamps_s": [{}],
 "calibration": {{"image_width": 640, "image_height": 480, "model": "opencv-radtan", "fx": 605,
  "fy": 605, "cx": 319.5, "cy": 239.5, "distortion_k1_k2_p1_p2_k3": [0, 0, 0, 0, 0]}},
 "latitude_deg": 50.0875, "longitude_deg": 14.4213, "utc": "2025-09-14T11:05:00Z",
 "marker": {{"size_m": 0.5, "heading_deg": 342}}}})",
                  frames, stamps));
  WriteFile(folder / "scene.toml", std::string(R"(time = "2025-09-14T11:05:00Z"
cloudiness = "clear"
[place]
latitude_deg = 50.0875
longitude_deg = 14.4213
height_m = 220
[marker]
family = "sg"
size_m = 0.5
board_size_m = 0.6
heading_deg = 342
[[phantom]]
file = "phantom.obj"
)") + (with_object ? "[[object]]\nfile = \"object.obj\"\nshading = \"flat\"\n" : ""));
}

}  // namespace pleinair::e2e
