#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "compositor/coverage/pixel_marks.h"
#include "compositor/surfaces/drawn_mesh.h"

namespace pleinair::compositor {

/// A visible triangle in an image. Functions of a position in pixels, whose centers are at .5, are
/// planes: the scalar product with (x, y, 1).
struct ScreenTriangle {
  std::array<glm::dvec3, 3> edges;  ///< Positive inside.
  glm::dvec3 nearness;              ///< 1 / depth, 1/m.
  float nearest = 0.0F, farthest = 0.0F;
  glm::ivec2 first{0}, last{-1};  ///< Pixels that it may touch, both included.
  glm::vec3 normal{0.0F};         ///< Unit, where the mesh was lit.
  std::uint32_t component = 0;
  std::uint32_t id = 0;  ///< In the VisibilityBuffer; 0: it has no number.
  std::uint8_t kind = 0;
  bool is_object = false, has_holes = false;
};

/// What a camera sees, as OpenGL takes it.
struct PixelView {
  glm::mat4 clip_from_marker{1.0F};
  int width = 0, height = 0;
  /// Tiles of the image that are drawn, in disjoint rectangles.
  std::span<const PixelRect> within = {};

  double NearM() const;       ///< Depth of the near plane.
  double PixelAngle() const;  ///< Side of a pixel over its depth.
};

/// Projects meshes, finds the pixels in which they have edges, and the triangles in these pixels.
/// Memory is reused.
class ScreenTriangles {
 public:
  /// `meshes`: in the order of drawing. Triangles that face away, have no area, or have corners
  /// that are not numbers are left out.
  void Project(std::span<const DrawnMesh> meshes, const PixelView& view);

  /// Pixels with a silhouette, a border or a crease in them; numbered.
  const PixelMarks& marks() const { return marks_; }
  /// Triangles that may touch these pixels, in the order of drawing.
  std::span<const ScreenTriangle> triangles() const { return triangles_; }

 private:
  /// A part of a mesh's elements.
  struct Block {
    std::size_t mesh = 0, first = 0, last = 0;
  };
  using Line = std::array<glm::dvec2, 2>;

  /// Sets the blocks of all meshes. `count_of`: the number of a mesh's elements.
  template <typename Count>
  void DivideIntoBlocks(std::span<const DrawnMesh> meshes, const Count& count_of);
  void ProjectPositions(std::span<const DrawnMesh> meshes, const PixelView& view);
  void MarkEdges(std::span<const DrawnMesh> meshes, const PixelView& view);
  void FindTriangles(std::span<const DrawnMesh> meshes, const PixelView& view);

  PixelMarks marks_;
  std::vector<ScreenTriangle> triangles_;
  /// One a vertex: x and y in pixels, times the depth; the depth in metres.
  std::vector<glm::dvec3> projected_;
  std::vector<std::size_t> first_vertices_;  // One a mesh.
  std::vector<Block> blocks_;
  std::vector<std::vector<Line>> lines_;                // One a block.
  std::vector<std::vector<ScreenTriangle>> of_blocks_;  // Likewise.
};

}  // namespace pleinair::compositor
