#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "compositor/models/gltf_placement.h"
#include "compositor/models/model.h"

namespace tinygltf {
class Model;
struct Primitive;
}  // namespace tinygltf

namespace pleinair::compositor {

/// Four joints and weights a vertex: JOINTS_n and WEIGHTS_n.
struct SkinWeights {
  std::vector<std::array<float, 4>> joints;  ///< Numbers within the skin.
  std::vector<std::array<float, 4>> weights;
};

/// Inverse bind matrices of a skin; identities if it has none. The skin must be one of the file.
Result<std::vector<GltfPlacement>> InverseBinds(const tinygltf::Model& gltf, int skin,
                                                const std::string& where);

/// Reads at most two sets of a primitive. Errors: joints with a weight that the skin of `joints`
/// does not have; another number than `vertices`.
Result<std::vector<SkinWeights>> ReadSkinWeights(const tinygltf::Model& gltf,
                                                 const tinygltf::Primitive& primitive,
                                                 std::size_t joints, std::size_t vertices,
                                                 const std::string& where);

/// Adds a primitive's morph targets, times their weights, to a mesh that was read from it
/// (glTF 2.0, 3.7.2.2). Missing weights are zero. Errors: targets with another number of vertices.
Result<void> ApplyMorphTargets(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                               std::span<const float> weights, const std::string& where,
                               Mesh* mesh);

/// Bends a mesh by its skin: each vertex moves with up to eight joints by their weights (glTF 2.0,
/// 3.7.3). `placements`: of all nodes, ScenePlacements(). The node of the mesh itself does not
/// count. Errors: joints out of range, or another number of weights than vertices.
Result<void> ApplySkin(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive, int skin,
                       const std::vector<GltfPlacement>& placements, const std::string& where,
                       Mesh* mesh);

}  // namespace pleinair::compositor
