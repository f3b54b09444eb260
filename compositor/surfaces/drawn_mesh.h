#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "compositor/surfaces/mesh_outline.h"

namespace pleinair::compositor {

/// A mesh as SceneSurfaces draws it, for coverage that the processor computes. Refers to the
/// surfaces, and is valid until they change.
struct DrawnMesh {
  std::span<const glm::vec3> positions;         ///< Metres, where it was lit.
  std::span<const std::uint32_t> indices = {};  ///< Sorted by kind, three a triangle.
  /// One past the last index of each kind. Later triangles have no number.
  std::span<const int> ends = {};
  std::span<const std::uint32_t> components = {};  ///< One per vertex.
  std::span<const OutlineEdge> outline = {};
  glm::mat4 marker_from_lit{1.0F};
  std::uint32_t first_id = 1;  ///< Number of the first triangle in its VisibilityBuffer.
  bool is_object = false;
  bool has_holes = false;  ///< Alpha decides where its triangles are seen.
};

}  // namespace pleinair::compositor
