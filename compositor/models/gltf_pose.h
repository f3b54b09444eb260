#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "compositor/models/animation/gltf_clip.h"
#include "compositor/models/gltf_placement.h"
#include "compositor/models/model.h"

namespace tinygltf {
class Model;
}

namespace pleinair::compositor {

/// A moment of an animation of a model's file.
struct ModelPose {
  std::string animation;  ///< Its name, or its number from 0 on; empty: the pose of the nodes.
  double time_s = 0.0;    ///< Since its beginning. Before and after it, its first and last pose.
};

/// As LoadModel() without a pose, which shows the pose of a glTF file's nodes. Further errors: an
/// animation that the file does not have, or key frames that are damaged.
Result<Model> LoadModel(const std::filesystem::path& file, const ModelOptions& options,
                        const ModelPose& pose);

/// Checks values that tinygltf does not check: the version (2.x, minVersion 2.0), the default
/// scene, and indices of nodes and primitives below zero. Also the number of values of matrices,
/// rotations, scales and translations, and rotations of length zero. `where` names the file in the
/// error.
Result<void> CheckGltfValues(const tinygltf::Model& gltf, const std::string& where);

/// The animations of a file, with their durations.
std::vector<AnimationInFile> AnimationsOf(const tinygltf::Model& gltf);

/// Evaluates an animation at one moment. Errors as GltfClip::Read(). `where` names the file.
Result<GltfPose> PoseOf(const tinygltf::Model& gltf, const ModelPose& pose,
                        const std::string& where);

/// Placement of every node: scene from node coordinates. Nodes that contain themselves keep that of
/// their own.
std::vector<GltfPlacement> ScenePlacements(const tinygltf::Model& gltf, const GltfPose& pose);

}  // namespace pleinair::compositor
