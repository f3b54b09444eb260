#pragma once

// Internal: between the .cc files of this module; not installed.

#include <optional>
#include <string>

#include "base/error.h"

namespace tinygltf {
struct FsCallbacks;
}

namespace pleinair::compositor {

/// The folder of a model that tinygltf reads, and the first error about a file that the model
/// names.
struct GltfFolder {
  std::string folder;  ///< With a trailing slash; "./" for the working folder.
  std::optional<Error> error;
};

/// Restricts tinygltf's access to a model's buffers and images. It may read regular files below 4
/// GiB whose path is relative and leads to no file outside the folder (CheckBelongsToModel()).
/// Absolute paths are invalid, because glTF forbids them. Files in the working folder are not
/// found. Nothing is ever written.
///
/// tinygltf's own callbacks would also open folders and devices, and would trust any size that
/// those report. `folder` must outlive the callbacks.
tinygltf::FsCallbacks FilesBesideModel(GltfFolder* folder);

}  // namespace pleinair::compositor
