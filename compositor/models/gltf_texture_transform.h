#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>

namespace tinygltf {
struct TextureInfo;
}

namespace pleinair::compositor {

/// Which texture coordinates a texture takes, and how they are moved: KHR_texture_transform
/// (Khronos, glTF 2.0), whose text and example turn (u, v) to (v, −u) by a quarter turn.
struct UvMap {
  int set = 0;
  std::array<double, 2> offset{0.0, 0.0}, scale{1.0, 1.0};
  double rotation_rad = 0.0;
  bool operator==(const UvMap&) const = default;

  /// Infinite where IsWithinReach() would refuse it.
  std::array<float, 2> operator()(const std::array<float, 2>& uv) const;
};

/// Of a texture of a material; as the file has it where it has no such extension.
UvMap UvMapOf(const tinygltf::TextureInfo& texture);

/// Whether coordinates are numbers, and none so large that texels are lost to rounding.
bool IsWithinReach(const std::array<float, 2>& uv);

}  // namespace pleinair::compositor
