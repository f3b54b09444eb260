#include "compositor/models/gltf_pose.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "compositor/models/gltf_error.h"

namespace pleinair::compositor {
namespace {

/// tinygltf's index of what a file does not name.
constexpr int kNoIndex = -1;

Result<void> CheckGltfNode(const tinygltf::Node& node, const std::string& where) {
  constexpr double kMinLength = 1e-6;  // Length of a quaternion, which should be 1.
  for (const int index : {node.mesh, node.skin}) {
    if (index < kNoIndex) return GltfError(where, "refers to a mesh or skin below zero");
  }
  struct Values {
    const char* name;
    std::size_t given, wanted;
  };
  for (const Values& values : {Values{"matrix", node.matrix.size(), 16},
                               {"rotation", node.rotation.size(), 4},
                               {"scale", node.scale.size(), 3},
                               {"translation", node.translation.size(), 3}}) {
    if (values.given == 0 || values.given == values.wanted) continue;
    return GltfError(where, std::string("has a ") + values.name + " of " +
                                std::to_string(values.given) + " numbers, not " +
                                std::to_string(values.wanted));
  }
  if (node.rotation.empty()) return {};
  double squares = 0.0;
  for (const double value : node.rotation) squares += value * value;
  if (squares >= kMinLength * kMinLength) return {};
  return GltfError(where, "has a rotation whose quaternion is zero");
}

}  // namespace

Result<void> CheckGltfValues(const tinygltf::Model& gltf, const std::string& where) {
  const std::string& version = gltf.asset.version;
  const std::string& least = gltf.asset.minVersion;
  if (version.substr(0, 2) != "2." || (!least.empty() && least != "2.0")) {
    return InputError(where,
                      "is of glTF version " + ShortName(least.empty() ? version : least) +
                          "; this program reads 2.0",
                      "export it as glTF 2.0");
  }
  if (gltf.defaultScene < kNoIndex ||
      (gltf.defaultScene >= 0 && !IsGltfIndex(gltf.defaultScene, gltf.scenes.size()))) {
    return GltfError(where, "shows its scene " + std::to_string(gltf.defaultScene) + " of " +
                                std::to_string(gltf.scenes.size()));
  }
  for (std::size_t i = 0; i < gltf.nodes.size(); ++i) {
    PLEINAIR_RETURN_IF_ERROR(CheckGltfNode(gltf.nodes[i], where + ", node " + std::to_string(i)));
  }
  for (const tinygltf::Mesh& mesh : gltf.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (primitive.material >= kNoIndex && primitive.indices >= kNoIndex) continue;
      return GltfError(where, "refers to a material or to indices below zero");
    }
  }
  return {};
}

std::vector<AnimationInFile> AnimationsOf(const tinygltf::Model& gltf) {
  std::vector<AnimationInFile> animations;
  for (const tinygltf::Animation& animation : gltf.animations) {
    AnimationInFile& listed = animations.emplace_back();
    listed.name = ShortName(animation.name);
    for (const tinygltf::AnimationSampler& sampler : animation.samplers) {
      if (!IsGltfIndex(sampler.input, gltf.accessors.size())) continue;
      const auto& times = gltf.accessors[static_cast<std::size_t>(sampler.input)].maxValues;
      if (times.empty() || !std::isfinite(times[0])) continue;
      listed.duration_s = std::max(listed.duration_s, times[0]);
    }
  }
  return animations;
}

Result<GltfPose> PoseOf(const tinygltf::Model& gltf, const ModelPose& pose,
                        const std::string& where) {
  PLEINAIR_ASSIGN_OR_RETURN(const GltfClip clip, GltfClip::Read(gltf, pose.animation, where));
  return clip.At(pose.time_s);
}

std::vector<GltfPlacement> ScenePlacements(const tinygltf::Model& gltf, const GltfPose& pose) {
  std::vector<bool> is_child(gltf.nodes.size());
  for (const tinygltf::Node& node : gltf.nodes) {
    for (const int child : node.children) {
      if (IsGltfIndex(child, gltf.nodes.size())) is_child[static_cast<std::size_t>(child)] = true;
    }
  }
  std::vector<GltfPlacement> placements = pose.local;
  std::vector<bool> placed(gltf.nodes.size());
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < placements.size(); ++i) {
    if (is_child[i]) continue;
    placed[i] = true;
    open.push_back(i);
  }
  while (!open.empty()) {
    const std::size_t parent = open.back();
    open.pop_back();
    for (const int child : gltf.nodes[parent].children) {
      if (!IsGltfIndex(child, gltf.nodes.size())) continue;
      const auto index = static_cast<std::size_t>(child);
      if (placed[index]) continue;
      placed[index] = true;
      placements[index] = placements[parent] * pose.local[index];
      open.push_back(index);
    }
  }
  return placements;
}

}  // namespace pleinair::compositor
