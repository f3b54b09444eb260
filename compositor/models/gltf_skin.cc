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

/// Inverse bind matrices of a skin, column-major; identities if it has none.
Result<std::vector<GltfPlacement>> InverseBinds(const tinygltf::Model& gltf,
                                                const tinygltf::Skin& skin,
                                                const std::string& where) {
  std::vector<GltfPlacement> binds(skin.joints.size());
  if (skin.inverseBindMatrices < 0) return binds;
  PLEINAIR_ASSIGN_OR_RETURN(const auto matrices,
                            ReadGltfFloats<16>(gltf, skin.inverseBindMatrices, where));
  if (matrices.size() < binds.size()) {
    return GltfError(where, "a skin has fewer matrices than joints");
  }
  for (std::size_t i = 0; i < binds.size(); ++i) {
    const auto& m = matrices[i];
    binds[i] = {{{m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]}}, {m[12], m[13], m[14]}};
  }
  return binds;
}

/// Scene from bind coordinates, by joint.
Result<std::vector<GltfPlacement>> JointPlacements(const tinygltf::Model& gltf, int skin,
                                                   const std::vector<GltfPlacement>& placements,
                                                   const std::string& where) {
  if (!IsGltfIndex(skin, gltf.skins.size())) {
    return GltfError(where, "refers to a skin out of range");
  }
  const tinygltf::Skin& source = gltf.skins[static_cast<std::size_t>(skin)];
  PLEINAIR_ASSIGN_OR_RETURN(std::vector<GltfPlacement> joints, InverseBinds(gltf, source, where));
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
  for (int set = 0; set < kMaxSets; ++set) {
    const auto joint_set = primitive.attributes.find("JOINTS_" + std::to_string(set));
    const auto weight_set = primitive.attributes.find("WEIGHTS_" + std::to_string(set));
    if (joint_set == primitive.attributes.end() || weight_set == primitive.attributes.end()) break;
    PLEINAIR_ASSIGN_OR_RETURN(const auto numbers,
                              ReadGltfFloats<4>(gltf, joint_set->second, where));
    PLEINAIR_ASSIGN_OR_RETURN(const auto weights,
                              ReadGltfFloats<4>(gltf, weight_set->second, where));
    if (numbers.size() != count || weights.size() != count) {
      return GltfError(where, "a mesh has more or fewer joints or weights than positions");
    }
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (!(weights[i][k] > 0.0F)) continue;
        if (!(numbers[i][k] >= 0.0F && numbers[i][k] < static_cast<float>(joints.size()))) {
          return GltfError(where, "a vertex refers to a joint out of range");
        }
        Add(joints[static_cast<std::size_t>(numbers[i][k])], weights[i][k], &blended[i]);
        sums[i] += weights[i][k];
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
