#pragma once

// Meshes in image coordinates for tests of coverage, and exact areas.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "compositor/coverage/scene_coverage.h"
#include "compositor/surfaces/mesh_outline.h"

namespace pleinair::compositor {

/// A camera at the origin that looks along z. A point (x, y, z) is seen at the pixel position
/// (x, y) / z.
inline glm::mat4 ClipFromScene(int width, int height) {
  constexpr float kNear = 0.1F, kFar = 100.0F;
  glm::mat4 clip(0.0F);
  clip[0].x = 2.0F / static_cast<float>(width);
  clip[1].y = 2.0F / static_cast<float>(height);
  clip[2] = {-1.0F, -1.0F, (kFar + kNear) / (kFar - kNear), 1.0F};
  clip[3].z = -2.0F * kFar * kNear / (kFar - kNear);
  return clip;
}

/// A mesh with what DrawnMesh refers to.
struct TestMesh {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> components = {};
  std::vector<OutlineEdge> outline = {};
  std::array<int, 1> end{};

  /// Adds a convex polygon in image coordinates at a depth of each corner, seen from its front.
  void Add(const std::vector<glm::dvec2>& corners, const std::vector<double>& depths_m) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      positions.emplace_back(glm::dvec3(corners[i], 1.0) * depths_m[i]);
      components.push_back(component_count);
    }
    ++component_count;
    for (std::uint32_t i = 2; i < corners.size(); ++i) {
      for (const std::uint32_t k : {0U, i, i - 1}) indices.push_back(first + k);
    }
  }
  void Add(const std::vector<glm::dvec2>& corners, double depth_m) {
    Add(corners, std::vector<double>(corners.size(), depth_m));
  }

  /// `all_edges`: all of its edges are creases.
  DrawnMesh Drawn(bool is_object, std::uint32_t first_id = 1, bool all_edges = false) {
    const std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0F, 0.0F, -1.0F));
    outline = OutlineOf(positions, normals, indices, all_edges);
    for (OutlineEdge& edge : outline) edge.is_crease = all_edges;
    end[0] = static_cast<int>(indices.size());
    return {.positions = positions,
            .indices = indices,
            .ends = end,
            .components = components,
            .outline = outline,
            .first_id = first_id,
            .is_object = is_object};
  }

  std::uint32_t component_count = 0;
};

/// Corners of a rectangle that runs counter-clockwise where rows run downwards.
inline std::vector<glm::dvec2> Rectangle(double left, double top, double right, double bottom) {
  return {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
}

/// Coverage of an image.
class MeasuredImage {
 public:
  MeasuredImage(int width, int height, const std::vector<DrawnMesh>& meshes, int places = 64,
                bool with_samples = false)
      : coverage_(places, with_samples) {
    const PixelRect whole{0, 0, width, height};
    coverage_.Measure(meshes, {ClipFromScene(width, height), width, height, {&whole, 1}}, &pieces_);
  }

  const PixelMarks& marks() const { return coverage_.marks(); }
  std::span<const PixelPieces> pieces() const { return pieces_; }
  /// Null if the pixel has no edge.
  const PixelPieces* At(int x, int y) const {
    const std::uint64_t word = marks().Word(x / 64, y), bit = std::uint64_t{1} << (x % 64);
    if ((word & bit) == 0) return nullptr;
    return &pieces_[static_cast<std::size_t>(marks().FirstOf(x / 64, y)) +
                    static_cast<std::size_t>(std::popcount(word & (bit - 1)))];
  }

 private:
  SceneCoverage coverage_;
  std::vector<PixelPieces> pieces_;
};

inline int SumOf(std::uint32_t weights) {
  int sum = 0;
  for (; weights != 0; weights >>= 8) sum += static_cast<int>(weights & 255);
  return sum;
}

/// Area that a convex polygon has in common with a pixel (Sutherland and Hodgman 1974).
inline double AreaIn(std::vector<glm::dvec2> polygon, int x, int y) {
  for (int side = 0; side < 4; ++side) {
    const int axis = side / 2;
    const double at = (axis == 0 ? x : y) + side % 2, sign = side % 2 == 0 ? 1.0 : -1.0;
    std::vector<glm::dvec2> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      const double in_a = sign * (a[axis] - at), in_b = sign * (b[axis] - at);
      if (in_a >= 0.0) kept.push_back(a);
      if ((in_a >= 0.0) != (in_b >= 0.0)) kept.push_back(a + (b - a) * (in_a / (in_a - in_b)));
    }
    polygon = kept;
  }
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

}  // namespace pleinair::compositor
