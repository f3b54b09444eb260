#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <optional>

#include "compositor/models/model.h"

namespace tinygltf {
struct TextureInfo;
struct NormalTextureInfo;
class Value;
}  // namespace tinygltf

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

/// Texture coordinates of a mesh whose material has several textures.
struct MaterialUvs {
  UvMap first;                    ///< Map of Mesh::uvs: that of a base color texture, if any.
  std::optional<int> second_set;  ///< Set in VertexDetail::uv; unset: none.
};

/// Expresses a texture's map by the coordinates of a mesh. Takes a second set if it is still free.
/// Returns nothing if a third set would be needed.
std::optional<TextureCoordinates> CoordinatesIn(MaterialUvs* uvs, const UvMap& map);

/// A texture of a material's extension, as tinygltf reads those of the core. Index -1: none.
tinygltf::TextureInfo TextureInfoOf(const tinygltf::Value& texture);

/// The map of a material's texture; without the extension, the texture's own coordinates.
UvMap UvMapOf(const tinygltf::TextureInfo& texture);
UvMap UvMapOf(const tinygltf::NormalTextureInfo& texture);

/// Returns whether coordinates are numbers, and small enough that rounding loses no texels.
bool IsWithinReach(const std::array<float, 2>& uv);

}  // namespace pleinair::compositor
