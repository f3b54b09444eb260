#pragma once

// Internal: between the .cc files of this module; not installed.

#include <string>

namespace tinygltf {
struct FsCallbacks;
}

namespace pleinair::compositor {

/// How tinygltf may reach a model's buffers and pictures: regular files below 4 GiB, named from the
/// model's folder (also above it by "..", as glTF allows; not by absolute paths, which it forbids),
/// never one that merely lies in the working folder. tinygltf's own calls would open folders and
/// devices as well and believe whatever size those claim. `folder` (its parent's path with a slash
/// at its end, "./" for the working folder) must outlive the callbacks; nothing is ever written.
tinygltf::FsCallbacks FilesBesideModel(std::string* folder);

}  // namespace pleinair::compositor
