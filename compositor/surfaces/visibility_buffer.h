#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/surfaces/linear_shadow_ratio.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// A mesh's indices, sorted by kind of triangle; `ends` has one past the last index of each kind.
struct SortedTriangles {
  std::span<const std::uint32_t> indices;
  std::span<const int> ends;
  std::span<const LinearShadowRatio> linear_ratios;  ///< Ratios of one kind, or empty.
  std::size_t first_ratio = 0;  ///< The triangle that the first of them belongs to.
};

/// Visibility buffer: triangles in textures, for shaders that read each pixel's triangle number
/// (shaders/visibility_buffer.glsl). Each pixel is shaded once; drawing the triangles would shade
/// pixels on their edges several times. Burns & Hunt 2013, "The Visibility Buffer: A Cache-Friendly
/// Approach to Deferred Shading". Needs a current OpenGL context; move-only.
class VisibilityBuffer {
 public:
  /// Layout; twins of shaders/visibility_buffer_layout.glsl.
  static constexpr int kTrianglesPerRow = 4096, kVerticesPerRow = 1365, kTexelsPerVertex = 3;
  static constexpr int kLinearRatiosPerRow = 819;
  static constexpr std::uint32_t kKindBits =
      3;  ///< Low bits of a triangle's last number, below its component.

  VisibilityBuffer() = default;
  /// Makes the table for meshes that are all phantoms or all virtual objects, without vertices
  /// until SetLight(). `values`: one per mesh, which shaders query by component. Errors (system):
  /// more vertices than a texture holds (11 million with llvmpipe), no memory.
  static Result<VisibilityBuffer> Create(std::span<const LitMesh* const> meshes,
                                         std::span<const float> values);

  /// Sets the vertices and their light, for the meshes passed to Create(). Errors as Create().
  Result<void> SetLight(std::span<const LitMesh* const> meshes, const LightMix& mix = {});

  /// Numbers each mesh's triangles before the last of its ends, in order. Memory is reused between
  /// calls and never shrinks. Errors as Create().
  Result<void> SetTriangles(std::span<const SortedTriangles> meshes);

  /// Number of a mesh's first triangle; the others follow.
  int first_id(std::size_t mesh) const { return first_ids_[mesh]; }
  /// Components of a mesh's vertices.
  std::span<const std::uint32_t> components(std::size_t mesh) const {
    const std::size_t end =
        mesh + 1 < first_vertices_.size() ? first_vertices_[mesh + 1] : components_.size();
    return std::span(components_).subspan(first_vertices_[mesh], end - first_vertices_[mesh]);
  }
  /// Binds the shaders' table to units 1 and 6, and the values by component to unit 7.
  void Bind() const;
  /// Binds the triangles' linear shadow ratios to unit 1.
  void BindLinearRatios() const { linear_ratios_.Bind(1); }

 private:
  gl::GlTexture triangles_, vertices_, values_, linear_ratios_;
  std::vector<std::uint32_t> first_vertices_;           // One per mesh.
  std::vector<std::uint32_t> components_;               // One per vertex.
  std::vector<int> first_ids_;                          // One per mesh.
  std::vector<std::array<float, 4>> vertex_texels_;     // kTexelsPerVertex each.
  std::vector<std::array<std::uint32_t, 4>> texels_;    // One per triangle.
  std::vector<LinearShadowRatio> linear_ratio_texels_;  // One per triangle; unused for some kinds.
};

/// Numbers the connected components of a surface from `first` on, one number per vertex. Triangles
/// connect vertices; creases, where vertices have two normals, separate components.
std::vector<std::uint32_t> ComponentsOf(const LitMesh& mesh, std::uint32_t first);

}  // namespace pleinair::compositor
