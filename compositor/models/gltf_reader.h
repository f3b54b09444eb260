#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "base/error.h"
#include "compositor/models/animation/gltf_rig.h"
#include "compositor/models/gltf_pose.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// Returns whether a file's content is glTF, either text (JSON) or binary.
bool LooksLikeGltf(std::string_view content);

/// Parses glTF 2.0 (.gltf or .glb) with the buffers and images beside `file`. The nodes of the
/// default scene become one model. glTF is y-up; the marker's frame is z-up.
/// (x, y, z) becomes (x, −z, y). Lengths remain in metres.
///
/// Base color, metallic and roughness are supported (factors and textures), also alphaMode and
/// alphaCutoff. So are normal maps, emission with its strength, vertex colors, unlit materials and
/// KHR_texture_transform. Further supported extensions are KHR_materials_ior, _specular,
/// _clearcoat, _sheen, _diffuse_transmission and _transmission. Their scalar textures are replaced
/// by the mean. The textures of a material may use two sets of texture coordinates. With a third,
/// metallic and roughness are replaced by their mean.
///
/// Skins and morph targets have the shape of `pose`. KHR_mesh_quantization, and with their
/// libraries EXT_meshopt_compression, KHR_draco_mesh_compression and EXT_texture_webp are read.
///
/// Model::unsupported_features and Material::unsupported_features report unsupported content. It
/// comprises other material extensions, animations of which none is chosen, points and lines.
/// Cameras and lights are ignored without a report.
///
/// Errors: cut short, references out of range, nodes that contain themselves, values that are not
/// finite, textures missing or too large, an unknown required extension.
Result<Model> ParseGltf(std::string content, const std::filesystem::path& file,
                        const ModelPose& pose = {});

/// A glTF file in the pose of its nodes, and what moves it.
struct MovingGltf {
  Model model;
  std::shared_ptr<GltfRig> rig;
};

/// As ParseGltf(), with an animation. Further errors as GltfRig::Create().
Result<MovingGltf> ParseMovingGltf(std::string content, const std::filesystem::path& file,
                                   const std::string& animation);

}  // namespace pleinair::compositor
