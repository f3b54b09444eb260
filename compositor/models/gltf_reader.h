#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// Whether a file's content is glTF, text (JSON) or binary.
bool LooksLikeGltf(std::string_view content);

/// Parses glTF 2.0 (.gltf or .glb) with the buffers and pictures beside `file`. The nodes of the
/// default scene are placed into one model. glTF is y-up; ours is the marker's frame, z-up:
/// (x, y, z) becomes (x, −z, y). Metres stay metres. Base color, metallic and
/// roughness (factors and textures, of one set of texture coordinates; where there are two, the
/// mean of the second texture), alphaMode, alphaCutoff, doubleSided and KHR_texture_transform are
/// read. Colours of vertices, normal maps, emission, other extensions of materials, skins, morph
/// targets, animations, points and lines are left out, which Model::unsupported_features and
/// Material::unsupported_features say; cameras and lamps are passed over.
/// Errors: cut short, references out of range, nodes that contain themselves, values that are not
/// finite, textures missing or too large, a required extension that is not known.
Result<Model> ParseGltf(const std::string& content, const std::filesystem::path& file);

}  // namespace pleinair::compositor
