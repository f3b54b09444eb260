#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compositor/models/model.h"

namespace pleinair::compositor {

/// What the phantoms leave a triangle of the sun.
enum class SunVisibility : std::uint8_t {
  kSome,  ///< A part of it, or not known.
  kAll,
  kNone,
};

/// The sun on the triangles of a phantom.
struct SunVisibilities {
  /// Empty when not computed: very large meshes, a light by coefficients, or no sun.
  std::vector<SunVisibility> by_triangle;
  std::array<float, 3> to_sun{};  ///< Where the sun stood for that: unit, marker coordinates.
};

/// A tessellated surface with the light that falls on its vertices besides the sun's own. Marker
/// coordinates. The unit of irradiance is the Daylight's (lux, linear Rec.709).
///
/// Triangles run counter-clockwise seen from the side that the normals point to and that the light
/// is for: draw them with back faces culled. Closed bodies (walls, boxes) come once, their outside.
/// Open surfaces (ground, awnings, leaves) come twice in a row, once for each side, first the side
/// that sees more of the sky; how the file winds them does not matter.
struct LitMesh {
  bool is_phantom = false;
  int placed_model = 0;  ///< Index into the scene's list of placed models.
  int material = 0;      ///< Index into that model's materials.
  /// Equal for meshes that nothing but their light tells apart; 0: not known.
  std::uint64_t geometry = 0;
  /// kRenderOnly casts no shadow, kShadowOnly is not drawn. Phantoms are kAll, their loose leaves
  /// kRenderOnly (compositor/light/foliage.h).
  MeshRole role = MeshRole::kAll;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<float, 2>> uvs;  ///< Empty, or one a position.
  /// Sky and bounced light with the virtual objects there.
  std::vector<std::array<float, 3>> ambient_with;
  /// The same with the phantoms alone; of phantoms only, empty for virtual objects.
  std::vector<std::array<float, 3>> ambient_without;
  std::vector<std::uint32_t> indices;
  SunVisibilities sun_visibility;
};

}  // namespace pleinair::compositor
