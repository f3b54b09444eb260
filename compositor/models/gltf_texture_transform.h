#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>

namespace tinygltf {
struct TextureInfo;
}

namespace pleinair::compositor {

/// Selects and transforms a texture's coordinates by KHR_texture_transform (Khronos, glTF 2.0). By
/// its text and example, a quarter turn maps (u, v) to (v, −u).
struct UvMap {
  int set = 0;
  std::array<double, 2> offset{0.0, 0.0}, scale{1.0, 1.0};
  double rotation_rad = 0.0;
  bool operator==(const UvMap&) const = default;

  /// Infinite if IsWithinReach() would reject the result.
  std::array<float, 2> operator()(const std::array<float, 2>& uv) const;
};

/// The map of a material's texture; without the extension, the texture's own coordinates.
UvMap UvMapOf(const tinygltf::TextureInfo& texture);

/// Returns whether coordinates are numbers, and small enough that rounding loses no texels.
bool IsWithinReach(const std::array<float, 2>& uv);

}  // namespace pleinair::compositor
