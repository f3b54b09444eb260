#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/surfaces/linear_shadow_ratio.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// A mesh's indices, sorted by kinds of triangles; one past the last index of each kind.
struct SortedTriangles {
  std::span<const std::uint32_t> indices;
  std::span<const int> ends;
  std::span<const LinearShadowRatio>
      linear_ratios;  ///< Of the last kind that has numbers, or none.
};

/// Triangles in textures, for shaders that learn from a picture of numbers what each pixel shows
/// (shaders/visibility_buffer.glsl). Pixels are then shaded once, where drawing the triangles
/// shades each pixel along their edges several times: Burns & Hunt 2013, "The Visibility Buffer: A
/// Cache-Friendly Approach to Deferred Shading". Needs a current OpenGL context; move-only.
class VisibilityBuffer {
 public:
  /// How it is laid out: twins of shaders/visibility_buffer_layout.glsl.
  static constexpr int kTrianglesPerRow = 4096, kVerticesPerRow = 1365, kTexelsPerVertex = 3;
  static constexpr int kLinearRatiosPerRow = 819;
  static constexpr std::uint32_t kKindBits =
      3;  ///< Of a triangle's last number; then its component.

  VisibilityBuffer() = default;
  /// Of meshes that are all phantoms or none; `values` by mesh, what the shaders may ask of each
  /// component of it. Without vertices until SetLight(). Errors (system): more vertices than a
  /// texture holds (11 million with llvmpipe), no memory.
  static Result<VisibilityBuffer> Create(std::span<const LitMesh* const> meshes,
                                         std::span<const float> values);

  /// The vertices with their light, of the meshes that the table was made of. Errors as Create().
  Result<void> SetLight(std::span<const LitMesh* const> meshes);

  /// The triangles that have numbers, by mesh in their order: those before the last of its ends.
  /// Memory is kept from call to call and grows alone. Errors as Create().
  Result<void> SetTriangles(std::span<const SortedTriangles> meshes);

  /// Number of a mesh's first triangle; the others follow.
  int first_id(std::size_t mesh) const { return first_ids_[mesh]; }
  /// Binds the shaders' table, units 1 and 6, and the values by component, unit 7.
  void Bind() const;
  /// Binds the triangles' steady ratios, unit 1.
  void BindLinearRatios() const { linear_ratios_.Bind(1); }

 private:
  gl::GlTexture triangles_, vertices_, values_, linear_ratios_;
  std::vector<std::uint32_t> first_vertices_;           // By mesh.
  std::vector<std::uint32_t> components_;               // By vertex.
  std::vector<int> first_ids_;                          // By mesh.
  std::vector<std::array<std::uint32_t, 4>> texels_;    // Of the triangles.
  std::vector<LinearShadowRatio> linear_ratio_texels_;  // By triangle; of some kinds not used.
};

/// Numbers the pieces of surface that hang together by their triangles' vertices, from `first` on,
/// one number a vertex: pieces are apart at creases, where vertices have two normals.
std::vector<std::uint32_t> ComponentsOf(const LitMesh& mesh, std::uint32_t first);

}  // namespace pleinair::compositor
