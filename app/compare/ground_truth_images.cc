#include "app/compare/ground_truth_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include <nlohmann/json.hpp>

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

bool IsFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

Result<std::vector<GroundTruthImage>> OfKeyFrames(const fs::path& folder, const Json& scene,
                                                  bool glossy) {
  const char* const truth = glossy ? "truth_glossy" : "truth";
  std::vector<GroundTruthImage> pictures;
  for (const Json& key : scene.at("key_frames")) {
    if (!key.contains(truth)) continue;
    GroundTruthImage picture;
    picture.name = fmt::format("{:04}", key.at("frame").get<int>());
    picture.truth = folder / key.at(truth).get<std::string>();
    if (key.contains("object_mask") && key.contains("shadow")) {
      picture.object = folder / key.at("object_mask").get<std::string>();
      picture.shadow = folder / key.at("shadow").get<std::string>();
    }
    for (const fs::path& file : {picture.truth, picture.object, picture.shadow}) {
      if (!file.empty() && !IsFile(file)) {
        return InputError(file.string(), "is missing, though scene.json names it",
                          "get the whole recording");
      }
    }
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace

Result<std::vector<GroundTruthImage>> FindKeyFrames(const fs::path& folder, bool glossy) {
  const fs::path scene = folder / "scene.json";
  if (!IsFile(scene)) return std::vector<GroundTruthImage>();
  try {
    std::ifstream stream(scene);
    const Json json = Json::parse(stream);
    if (!json.contains("key_frames")) return std::vector<GroundTruthImage>();
    return OfKeyFrames(folder, json, glossy);
  } catch (const Json::exception&) {
    return InputError(scene.string(), "is no JSON, or its key_frames are not as documented",
                      "correct its key_frames");
  }
}

Result<std::vector<GroundTruthImage>> FindGroundTruthImages(const fs::path& folder, bool glossy) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return InputError(folder.string(), "is no folder", "name a recording with ground-truth images");
  }
  PLEINAIR_ASSIGN_OR_RETURN(std::vector<GroundTruthImage> pictures, FindKeyFrames(folder, glossy));
  if (!IsFile(folder / "scene.json")) {
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() != ".png" || !entry.is_regular_file(error)) continue;
      pictures.push_back({entry.path().stem().string(), entry.path(), {}, {}});
    }
    std::sort(pictures.begin(), pictures.end(),
              [](const GroundTruthImage& a, const GroundTruthImage& b) { return a.name < b.name; });
  }
  if (pictures.empty()) {
    return InputError(folder.string(), "has no ground-truth image",
                      "name a recording whose scene.json lists key_frames, or a folder of PNGs");
  }
  return pictures;
}

Result<fs::path> FindPicture(const fs::path& folder, const std::string& name) {
  for (const fs::path& file : {folder / "frames" / (name + ".png"), folder / (name + ".png")}) {
    if (IsFile(file)) return file;
  }
  return InputError(folder.string(), "has no image " + name + ".png",
                    "replay the whole recording with --frames");
}

}  // namespace pleinair::app
