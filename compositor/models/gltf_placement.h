#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>

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

/// Computes a node's transform from its matrix, or from its rotation, scale and translation (glTF
/// 2.0, section 3.5.2).
GltfPlacement PlacementOf(const tinygltf::Node& node);

bool IsFinite(const GltfPlacement& placement);

/// Turns a unit normal by the inverse transpose of a matrix, whose cofactors suffice: the result
/// has unit length. Zero where the matrix squeezes the surface to nothing.
std::array<float, 3> TurnedNormal(const Mat3& m, const std::array<float, 3>& n);

}  // namespace pleinair::compositor
