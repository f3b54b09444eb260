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

/// Pictures that come as files or data URIs, still encoded, by index. Those in buffer views are
/// read later: tinygltf does not check where they end.
using EncodedGltfImages = std::map<int, std::vector<unsigned char>>;

/// Adds the materials of a glTF file and the textures that they are drawn with to the model, and
/// after them one for primitives that have none. Returns the texture coordinates of each material
/// of the file. Errors: textures out of range, missing, too large or unreadable.
Result<std::vector<UvMap>> ReadGltfMaterials(const tinygltf::Model& gltf,
                                             const EncodedGltfImages& encoded,
                                             const std::filesystem::path& file, Model* model);

}  // namespace pleinair::compositor
