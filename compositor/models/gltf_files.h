#pragma once

// Internal: between the .cc files of this module; not installed.

#include <string>

namespace tinygltf {
struct FsCallbacks;
}

namespace pleinair::compositor {

/// Restricts tinygltf's access to a model's buffers and images. It may read regular files below 4
/// GiB whose path is relative to the model's folder. Paths with ".." are valid, as glTF allows;
/// absolute paths are not, because glTF forbids them. Files in the working folder are not found.
/// Nothing is ever written.
///
/// tinygltf's own callbacks would also open folders and devices, and would trust any size that
/// those report. `folder` must outlive the callbacks. It is the parent path with a trailing slash,
/// or "./" for the working folder.
tinygltf::FsCallbacks FilesBesideModel(std::string* folder);

}  // namespace pleinair::compositor
