#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compositor/light/light_mix.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// How much of the sun reaches a triangle past the phantoms.
enum class SunVisibility : std::uint8_t {
  kSome,  ///< A part of it, or not computed.
  kAll,
  kNone,
};

/// Sunlight on a mesh.
struct MeshSunlight {
  /// Sun visibility of a phantom's triangles, one entry each. Empty when not computed: very large
  /// meshes, light from daylight coefficients, or no sun.
  std::vector<SunVisibility> by_triangle;
  std::array<float, 3> to_sun{};  ///< Sun direction of these entries: unit, marker coordinates.
  /// The part of LitMesh::ambient_with and ambient_without that is reflected sunlight. The rest
  /// comes from the sky. Empty: none of it.
  std::vector<std::array<float, 3>> reflected_with, reflected_without;
  /// From a virtual object's vertices to the curved surface that its normals describe, where that
  /// lies outside the triangles (SurfaceMesh::lifts). Empty: zero.
  std::vector<std::array<float, 3>> lifts;
};

/// Attributes of a mesh besides geometry and light.
struct MeshTexturing {
  std::vector<std::array<float, 2>> uvs;  ///< Empty, or one per position.
  std::vector<VertexDetail> details;      ///< Empty, or one per position.
  /// The mesh is the side of an open surface that faces away from the file's winding. Bumps that
  /// stick out of the front go into the back.
  bool is_back = false;
  /// Diffuse reflectance that its light was computed with: linear Rec.709, the mean of textures and
  /// colors of vertices.
  std::array<float, 3> reflectance{};
  /// The same transmittance of a virtual object's open surface.
  std::array<float, 3> transmittance{};
};

/// A tessellated surface with the irradiance at its vertices, without direct sunlight. Marker
/// coordinates. Irradiance has the Daylight's unit (lux, linear Rec.709).
///
/// Triangles run counter-clockwise seen from the side that the normals point to and that is lit.
/// Draw them with back-face culling. A closed body (wall, box) has one mesh, its outside. An open
/// surface (ground, awning, leaf) has two consecutive meshes, one per side. The side that sees more
/// of the sky is first, whatever the winding in the file.
struct LitMesh {
  bool is_phantom = false;
  int placed_model = 0;  ///< Index into the scene's list of placed models.
  int material = 0;      ///< Index into that model's materials.
  /// Equal for meshes that differ in nothing but their light; 0: unknown.
  std::uint64_t geometry = 0;
  /// kRenderOnly casts no shadow; kShadowOnly is not drawn. Phantoms are kAll, their foliage is
  /// kRenderOnly (compositor/light/foliage.h).
  MeshRole role = MeshRole::kAll;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;
  MeshTexturing texturing;
  /// Sky and bounced light with the virtual objects present.
  std::vector<std::array<float, 3>> ambient_with;
  /// The same with the phantoms alone. For a virtual object's side of a surface that transmits
  /// light: the light on its other side. Empty for other virtual objects.
  std::vector<std::array<float, 3>> ambient_without;
  std::vector<std::uint32_t> indices;
  MeshSunlight sunlight;

  /// True for a virtual object whose other side's light shines through.
  bool IsTranslucent() const { return !is_phantom && !ambient_without.empty(); }

  /// The light of a vertex when sun and sky are `mix` times as strong.
  std::array<float, 3> AmbientWith(std::size_t vertex, const LightMix& mix) const {
    return Mixed(ambient_with, sunlight.reflected_with, vertex, mix);
  }
  std::array<float, 3> AmbientWithout(std::size_t vertex, const LightMix& mix) const {
    return Mixed(ambient_without, sunlight.reflected_without, vertex, mix);
  }

 private:
  using Light = std::vector<std::array<float, 3>>;
  static std::array<float, 3> Mixed(const Light& ambient, const Light& reflected,
                                    std::size_t vertex, const LightMix& mix) {
    return mix.Ambient(ambient[vertex],
                       reflected.empty() ? std::array<float, 3>{} : reflected[vertex]);
  }
};

}  // namespace pleinair::compositor
