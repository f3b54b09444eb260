#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <optional>

#include "base/vector.h"

namespace tinygltf {
class Node;
}

namespace pleinair::compositor {

/// Affine map of a node: parent from node coordinates, metres.
struct GltfPlacement {
  Mat3 linear;
  Vec3 translation_m;
  GltfPlacement operator*(const GltfPlacement& inner) const {
    return {linear * inner.linear, linear * inner.translation_m + translation_m};
  }
};

/// glTF's y-up, −z-forward axes to ours: z up.
inline constexpr GltfPlacement kUpright{{{1, 0, 0, 0, 0, -1, 0, 1, 0}}, {}};

/// The transform of a node (glTF 2.0, section 3.5.2): a matrix, or scale, then rotation, then
/// translation.
struct GltfTransform {
  std::optional<GltfPlacement> matrix;         ///< In place of the rest.
  std::array<double, 4> rotation{0, 0, 0, 1};  ///< Quaternion x, y, z, w, of any length.
  Vec3 scale{1, 1, 1};
  Vec3 translation_m;

  /// Parent from node coordinates.
  GltfPlacement Placement() const;
};

GltfTransform TransformOf(const tinygltf::Node& node);

bool IsFinite(const GltfPlacement& placement);

/// Turns a unit normal by the inverse transpose of a matrix, whose cofactors suffice: the result
/// has unit length. Zero where the matrix squeezes the surface to nothing.
std::array<float, 3> TurnedNormal(const Mat3& m, const std::array<float, 3>& n);

}  // namespace pleinair::compositor
