#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace pleinair::compositor {

/// An edge between triangles of a mesh that may be visible as an edge in an image.
struct OutlineEdge {
  static constexpr std::uint32_t kNone = ~0U;
  /// Ends, in the order of the first triangle, whose third corner is `corner`.
  std::uint32_t a = 0, b = 0, corner = 0;
  std::uint32_t other_corner = kNone;  ///< Third corner of the second triangle; kNone: a border.
  bool is_crease = false;              ///< Visible wherever one of its triangles is.
};

/// Finds a mesh's borders, creases and convex edges: no other edge is ever part of a silhouette.
/// Vertices at one position are one. A crease has normals whose cosine is below kAlike on both
/// sides. `all`: also edges that are flat or concave, for a mesh whose shape changes. Triangles
/// without area and positions that are not numbers have no edges.
std::vector<OutlineEdge> OutlineOf(std::span<const glm::vec3> positions,
                                   std::span<const glm::vec3> normals,
                                   std::span<const std::uint32_t> indices, bool all = false);

/// Cosine of normals from which on a surface is one piece; twin of shaders/object_pixels.frag.
inline constexpr float kAlike = 0.9F;

}  // namespace pleinair::compositor
