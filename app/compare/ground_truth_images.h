#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// One picture that there is a truth for.
struct GroundTruthImage {
  std::string name;                      ///< "0036".
  std::filesystem::path truth;           ///< The picture with the object really there.
  std::filesystem::path object, shadow;  ///< Regions (PictureRegions); empty: nobody knows.
};

/// Of a recording: what the `key_frames` of its scene.json name; empty where there are none. Errors
/// (input): a scene.json that cannot be read, a file that it names is missing.
Result<std::vector<GroundTruthImage>> FindKeyFrames(const std::filesystem::path& folder,
                                                    bool glossy);

/// What a recording with ground truth (a folder whose scene.json lists `key_frames`), or a folder
/// of pictures NNNN.png, has true pictures of. `glossy`: of the glossy variant of the object.
/// Errors (input): no such folder, nothing true in it, a file that it names is missing.
Result<std::vector<GroundTruthImage>> FindGroundTruthImages(const std::filesystem::path& folder,
                                                            bool glossy);

/// Where a replay's output, or a folder of pictures, has the picture of that name. Errors (input):
/// nowhere.
Result<std::filesystem::path> FindPicture(const std::filesystem::path& folder,
                                          const std::string& name);

}  // namespace pleinair::app
