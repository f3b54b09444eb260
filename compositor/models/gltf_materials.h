#pragma once

// Internal: between the .cc files of this module; not installed.

#include <filesystem>
#include <map>
#include <vector>

#include "base/error.h"
#include "compositor/models/gltf_texture_transform.h"
#include "compositor/models/model.h"

namespace tinygltf {
class Model;
}

namespace pleinair::compositor {

/// Still encoded images from files or data URIs, by index. Images in buffer views are read later,
/// because tinygltf does not check their bounds.
using EncodedGltfImages = std::map<int, std::vector<unsigned char>>;

/// Adds a glTF file's materials with their textures to the model, followed by one material for
/// primitives without any. Returns the texture coordinates of each
/// material of the file. Errors:
/// textures out of range, missing, too large or unreadable.
Result<std::vector<MaterialUvs>> ReadGltfMaterials(const tinygltf::Model& gltf,
                                                   const EncodedGltfImages& encoded,
                                                   const std::filesystem::path& file, Model* model);

}  // namespace pleinair::compositor
