#include "compositor/models/gltf_skin.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/vector.h"
#include "compositor/models/gltf_accessor.h"
#include "compositor/models/gltf_error.h"
#include "compositor/models/model_limits.h"

namespace pleinair::compositor {
namespace {

using Float3 = std::array<float, 3>;

// Sets of four joints a vertex: JOINTS_0 and JOINTS_1.
constexpr int kMaxSets = 2;

Result<void> AddScaled(const tinygltf::Model& gltf, int accessor, float weight,
                       const std::string& where, std::vector<Float3>* values) {
  PLEINAIR_ASSIGN_OR_RETURN(const auto deltas, ReadGltfFloats<3>(gltf, accessor, where));
  if (deltas.size() != values->size()) {
    return GltfError(where, "a morph target has more or fewer vertices than its mesh");
  }
  for (std::size_t i = 0; i < deltas.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) (*values)[i][c] += weight * deltas[i][c];
  }
  return {};
}

/// Scene from bind coordinates, by joint.
Result<std::vector<GltfPlacement>> JointPlacements(const tinygltf::Model& gltf, int skin,
                                                   const std::vector<GltfPlacement>& placements,
                                                   const std::string& where) {
  if (!IsGltfIndex(skin, gltf.skins.size())) {
    return GltfError(where, "refers to a skin out of range");
  }
  const tinygltf::Skin& source = gltf.skins[static_cast<std::size_t>(skin)];
  PLEINAIR_ASSIGN_OR_RETURN(std::vector<GltfPlacement> joints, InverseBinds(gltf, skin, where));
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!IsGltfIndex(source.joints[i], placements.size())) {
      return GltfError(where, "a skin refers to a joint out of range");
    }
    joints[i] = placements[static_cast<std::size_t>(source.joints[i])] * joints[i];
    if (!IsFinite(joints[i])) return GltfError(where, "the placement of a joint is not finite");
  }
  return joints;
}

void Add(const GltfPlacement& joint, double weight, GltfPlacement* sum) {
  for (std::size_t i = 0; i < 9; ++i) sum->linear.m[i] += weight * joint.linear.m[i];
  sum->translation_m = sum->translation_m + joint.translation_m * weight;
}

Float3 Narrowed(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

Result<std::vector<GltfPlacement>> InverseBinds(const tinygltf::Model& gltf, int skin,
                                                const std::string& where) {
  const tinygltf::Skin& source = gltf.skins[static_cast<std::size_t>(skin)];
  std::vector<GltfPlacement> binds(source.joints.size());
  if (source.inverseBindMatrices < 0) return binds;
  PLEINAIR_ASSIGN_OR_RETURN(const auto matrices,
                            ReadGltfFloats<16>(gltf, source.inverseBindMatrices, where));
  if (matrices.size() < binds.size()) {
    return GltfError(where, "a skin has fewer matrices than joints");
  }
  for (std::size_t i = 0; i < binds.size(); ++i) {
    const auto& m = matrices[i];
    binds[i] = {{{m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]}}, {m[12], m[13], m[14]}};
  }
  return binds;
}

Result<std::vector<SkinWeights>> ReadSkinWeights(const tinygltf::Model& gltf,
                                                 const tinygltf::Primitive& primitive,
                                                 std::size_t joints, std::size_t vertices,
                                                 const std::string& where) {
  std::vector<SkinWeights> sets;
  for (int set = 0; set < kMaxSets; ++set) {
    const auto joint_set = primitive.attributes.find("JOINTS_" + std::to_string(set));
    const auto weight_set = primitive.attributes.find("WEIGHTS_" + std::to_string(set));
    if (joint_set == primitive.attributes.end() || weight_set == primitive.attributes.end()) break;
    SkinWeights& read = sets.emplace_back();
    PLEINAIR_ASSIGN_OR_RETURN(read.joints, ReadGltfFloats<4>(gltf, joint_set->second, where));
    PLEINAIR_ASSIGN_OR_RETURN(read.weights, ReadGltfFloats<4>(gltf, weight_set->second, where));
    if (read.joints.size() != vertices || read.weights.size() != vertices) {
      return GltfError(where, "a mesh has more or fewer joints or weights than positions");
    }
    for (std::size_t i = 0; i < vertices; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        const float joint = read.joints[i][k];
        if (!(read.weights[i][k] > 0.0F)) continue;
        if (!(joint >= 0.0F && joint < static_cast<float>(joints))) {
          return GltfError(where, "a vertex refers to a joint out of range");
        }
      }
    }
  }
  return sets;
}

Result<void> ApplyMorphTargets(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive,
                               std::span<const float> weights, const std::string& where,
                               Mesh* mesh) {
  if (primitive.targets.size() > kMaxMorphTargets) {
    return GltfError(where,
                     "a mesh has more than " + std::to_string(kMaxMorphTargets) + " morph targets");
  }
  for (std::size_t i = 0; i < std::min(weights.size(), primitive.targets.size()); ++i) {
    if (weights[i] == 0.0F || !std::isfinite(weights[i])) continue;
    const auto& target = primitive.targets[i];
    if (const auto position = target.find("POSITION"); position != target.end()) {
      PLEINAIR_RETURN_IF_ERROR(
          AddScaled(gltf, position->second, weights[i], where, &mesh->positions));
    }
    if (const auto normal = target.find("NORMAL");
        normal != target.end() && !mesh->normals.empty()) {
      PLEINAIR_RETURN_IF_ERROR(AddScaled(gltf, normal->second, weights[i], where, &mesh->normals));
    }
  }
  return {};
}

Result<void> ApplySkin(const tinygltf::Model& gltf, const tinygltf::Primitive& primitive, int skin,
                       const std::vector<GltfPlacement>& placements, const std::string& where,
                       Mesh* mesh) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<GltfPlacement> joints,
                            JointPlacements(gltf, skin, placements, where));
  const std::size_t count = mesh->positions.size();
  std::vector<GltfPlacement> blended(count, {{{0, 0, 0, 0, 0, 0, 0, 0, 0}}, {}});
  std::vector<double> sums(count);
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<SkinWeights> sets,
                            ReadSkinWeights(gltf, primitive, joints.size(), count, where));
  for (const SkinWeights& set : sets) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (!(set.weights[i][k] > 0.0F)) continue;
        Add(joints[static_cast<std::size_t>(set.joints[i][k])], set.weights[i][k], &blended[i]);
        sums[i] += set.weights[i][k];
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!(sums[i] > 0.0)) continue;
    const auto& [x, y, z] = mesh->positions[i];
    mesh->positions[i] =
        Narrowed((blended[i].linear * Vec3{x, y, z} + blended[i].translation_m) * (1.0 / sums[i]));
    if (!mesh->normals.empty()) {
      mesh->normals[i] = TurnedNormal(blended[i].linear, mesh->normals[i]);
    }
  }
  return {};
}

}  // namespace pleinair::compositor
