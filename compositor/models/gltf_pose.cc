#include "compositor/models/gltf_pose.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "compositor/models/gltf_error.h"

namespace pleinair::compositor {

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
