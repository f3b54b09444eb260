#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.h"
#include "compositor/changing_triangles.h"
#include "compositor/light_solver.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// The phantoms' triangles in textures, for shaders that learn from a picture of numbers what each
/// pixel shows (shaders/triangle_table.glsl). Pixels are then shaded once, where drawing the
/// triangles shades each pixel along their edges several times: Burns & Hunt 2013, "The Visibility
/// Buffer: A Cache-Friendly Approach to Deferred Shading". Needs a current OpenGL context;
/// move-only.
class TriangleTable {
 public:
  /// How it is laid out: twins of shaders/triangle_layout.glsl.
  static constexpr int kTrianglesARow = 4096, kVerticesARow = 1365, kTexelsAVertex = 3;
  static constexpr std::uint32_t kKindBits = 2;  ///< Of a triangle's last number; then its sheet.

  TriangleTable() = default;
  /// Of the phantoms among `lit`; `green_albedo` by mesh of `lit`, 0 where it is not known. Errors
  /// (system): more vertices than a texture holds (11 million with llvmpipe), no memory.
  static Result<TriangleTable> Create(const std::vector<LitMesh>& lit,
                                      std::span<const float> green_albedo);

  /// The triangles that may change, by phantom in their order. Memory is kept from call to call and
  /// grows alone. Errors as Create().
  Result<void> SetTriangles(std::span<const ChangingTriangles> phantoms);

  /// Number of a phantom's first changing triangle; the others follow.
  int first_id(std::size_t phantom) const { return first_ids_[phantom]; }
  /// For the shaders' table, and for what they ask of sheets.
  void Bind() const;

 private:
  gl::GlTexture triangles_, vertices_, green_albedos_;
  std::vector<std::uint32_t> first_vertices_;         // By phantom.
  std::vector<std::uint32_t> sheets_;                 // By vertex.
  std::vector<int> first_ids_;                        // By phantom.
  std::vector<std::array<std::uint32_t, 4>> texels_;  // Of the triangles.
};

/// Numbers the pieces of surface that hang together by their triangles' vertices, from `first` on,
/// one number a vertex: pieces are apart at creases, where vertices have two normals.
std::vector<std::uint32_t> SheetsOf(const LitMesh& mesh, std::uint32_t first);

}  // namespace pleinair::compositor
