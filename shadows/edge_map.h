#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "base/error.h"
#include "gl/texture.h"
#include "shadows/caster_edges.h"

namespace pleinair::shadows {

/// Outlines of casters in the texels of a shadow map. A map has one depth a texel, so that edges of
/// shadows have steps of a texel. The line at which its caster ends divides a texel where the
/// shadow ends. Sen, Cammarano and Hanrahan 2003, "Shadow silhouette maps", divide it by a point
/// on the outline.
class EdgeMap {
 public:
  /// The two lines of a texel that are nearest to its centre, as EdgeLine() in
  /// shaders/shadow_formulae.glsl reads them; 0: none.
  using Lines = std::array<std::uint32_t, 2>;

  /// For a map of `side` rows and columns. Errors (system): no memory.
  static Result<EdgeMap> Create(int side);

  EdgeMap() = default;

  /// Edges of one caster and the matrix from its coordinates to (column, row, any); affine.
  struct Caster {
    std::span<const CasterEdge> edges;
    glm::dmat4 texel_from_model{1.0};
    glm::dvec3 to_sun{0.0};  ///< In its coordinates.
  };
  /// Draws the outlines in place of those before.
  void Draw(std::span<const Caster> casters);
  void Bind(int unit) const { texture_.Bind(unit); }

  /// A line at a distance of at most 0.75 texel from a centre. `to_line`: from the centre, unit.
  static std::uint32_t Packed(const glm::dvec2& to_line, double distance_texels);

 private:
  gl::GlTexture texture_;
  bool has_lines_ = true;  // The texture is not cleared yet.
};

}  // namespace pleinair::shadows
