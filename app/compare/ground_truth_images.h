#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"

namespace pleinair::app {

/// One image that has a ground truth.
struct GroundTruthImage {
  std::string name;                      ///< "0036".
  std::filesystem::path truth;           ///< The image with the real object.
  std::filesystem::path object, shadow;  ///< Regions (PictureRegions); empty: unknown.
};

/// Finds the `key_frames` of a recording's scene.json; empty if there are none. Errors (input): a
/// scene.json that cannot be read, or that names a missing file.
Result<std::vector<GroundTruthImage>> FindKeyFrames(const std::filesystem::path& folder,
                                                    bool glossy);

/// Finds the ground-truth images of a folder: a recording whose scene.json lists `key_frames`, or
/// images NNNN.png. `glossy`: use the glossy variant of the object. Errors (input): no such folder,
/// no ground truth in it, a missing file.
Result<std::vector<GroundTruthImage>> FindGroundTruthImages(const std::filesystem::path& folder,
                                                            bool glossy);

/// Finds the image of that name in a replay's output or a folder of images. Errors (input): there
/// is none.
Result<std::filesystem::path> FindPicture(const std::filesystem::path& folder,
                                          const std::string& name);

}  // namespace pleinair::app
