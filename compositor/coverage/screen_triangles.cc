#include "compositor/coverage/screen_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "base/parallel_for.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kElementsPerBlock = 8192;

using Corners = std::array<glm::dvec3, 3>;

/// Cross product of a and b that is exactly the negative of that of b and a, on every machine.
glm::dvec3 EdgeThrough(const glm::dvec3& a, const glm::dvec3& b) {
  const bool swaps = a.x != b.x ? a.x > b.x : a.y != b.y ? a.y > b.y : a.z > b.z;
  return swaps ? -glm::cross(b, a) : glm::cross(a, b);
}

/// Negative for triangles that are seen from their front: they run clockwise in an image whose rows
/// run downwards. Right for corners behind the camera, too.
double TurnOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::dot(a, glm::cross(b, c));
}

glm::dvec2 OnScreen(const glm::dvec3& projected) { return glm::dvec2(projected) / projected.z; }

/// The end of a line that is cut at the near plane, from `behind` towards `before` it.
glm::dvec3 AtNear(const glm::dvec3& behind, const glm::dvec3& before, double near_m) {
  const double share = (near_m - behind.z) / (before.z - behind.z);
  return behind + share * (before - behind);
}

struct Extent {
  glm::dvec2 low{std::numeric_limits<double>::max()};
  glm::dvec2 high{std::numeric_limits<double>::lowest()};
  void Include(const glm::dvec3& projected) {
    const glm::dvec2 at = OnScreen(projected);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
};

/// The rectangle of the part before the near plane.
Extent ExtentOf(const Corners& corners, double near_m) {
  Extent extent;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 3];
    if (a.z >= near_m) extent.Include(a);
    if ((a.z >= near_m) != (b.z >= near_m)) {
      extent.Include(a.z < near_m ? AtNear(a, b, near_m) : AtNear(b, a, near_m));
    }
  }
  return extent;
}

/// Sets the pixels that a triangle may touch. Returns whether there are any.
bool SetPixels(const Extent& extent, const PixelView& view, ScreenTriangle* triangle) {
  const glm::dvec2 size(view.width, view.height);
  // False for what is not a number.
  if (!(extent.low.x < size.x && extent.low.y < size.y && extent.high.x >= 0.0 &&
        extent.high.y >= 0.0)) {
    return false;
  }
  triangle->first = glm::ivec2(glm::floor(glm::max(extent.low, glm::dvec2(0.0))));
  triangle->last = glm::ivec2(glm::floor(glm::min(extent.high, size - 1.0)));
  return true;
}

/// Sets the planes. Returns whether they are numbers.
bool SetPlanes(const Corners& corners, double turn, double near_m, ScreenTriangle* triangle) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 edge = EdgeThrough(corners[(i + 1) % 3], corners[(i + 2) % 3]);
    triangle->edges[i] = -edge;
    sum += edge;
  }
  triangle->nearness = sum / turn;
  double nearest_m = std::numeric_limits<double>::max(), farthest_m = 0.0;
  for (const glm::dvec3& corner : corners) {
    nearest_m = std::min(nearest_m, corner.z);
    farthest_m = std::max(farthest_m, corner.z);
  }
  // Behind the near plane nothing is drawn.
  triangle->nearest = static_cast<float>(1.0 / std::max(nearest_m, 0.5 * near_m));
  triangle->farthest = static_cast<float>(1.0 / farthest_m);
  return std::isfinite(triangle->nearness.x + triangle->nearness.y + triangle->nearness.z);
}

}  // namespace

double PixelView::NearM() const {
  const glm::dmat4 rows = glm::transpose(glm::dmat4(clip_from_marker));
  const glm::dvec3 depth(rows[3]), clip(rows[2]);
  const double scale = glm::dot(clip, depth) / glm::dot(depth, depth);
  return (scale * rows[3].w - rows[2].w) / (1.0 + scale);
}

double PixelView::PixelAngle() const {
  const glm::dmat4 rows = glm::transpose(glm::dmat4(clip_from_marker));
  const glm::dvec3 depth(rows[3]), across(rows[0]);
  const double size = glm::length(depth);
  const glm::dvec3 ahead = depth / size;
  return 2.0 * size / (width * glm::length(across - glm::dot(across, ahead) * ahead));
}

template <typename Count>
void ScreenTriangles::DivideIntoBlocks(std::span<const DrawnMesh> meshes, const Count& count_of) {
  blocks_.clear();
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const std::size_t count = count_of(meshes[m]);
    for (std::size_t first = 0; first < count; first += kElementsPerBlock) {
      blocks_.push_back({m, first, std::min(count, first + kElementsPerBlock)});
    }
  }
}

void ScreenTriangles::ProjectPositions(std::span<const DrawnMesh> meshes, const PixelView& view) {
  DivideIntoBlocks(meshes, [](const DrawnMesh& mesh) { return mesh.positions.size(); });
  first_vertices_.clear();
  std::size_t vertices = 0;
  for (const DrawnMesh& mesh : meshes) {
    first_vertices_.push_back(vertices);
    vertices += mesh.positions.size();
  }
  projected_.resize(vertices);
  glm::dmat4 pixels_from_clip(1.0);
  pixels_from_clip[0].x = 0.5 * view.width;
  pixels_from_clip[1].y = 0.5 * view.height;
  pixels_from_clip[3].x = 0.5 * view.width;
  pixels_from_clip[3].y = 0.5 * view.height;
  ParallelFor(blocks_.size(), 0, [&](std::size_t i) {
    const auto& [m, first, last] = blocks_[i];
    const glm::dmat4 matrix = pixels_from_clip * glm::dmat4(view.clip_from_marker) *
                              glm::dmat4(meshes[m].marker_from_lit);
    for (std::size_t v = first; v < last; ++v) {
      const glm::dvec4 at = matrix * glm::dvec4(glm::dvec3(meshes[m].positions[v]), 1.0);
      projected_[first_vertices_[m] + v] = {at.x, at.y, at.w};
    }
  });
}

void ScreenTriangles::MarkEdges(std::span<const DrawnMesh> meshes, const PixelView& view) {
  DivideIntoBlocks(meshes, [](const DrawnMesh& mesh) { return mesh.outline.size(); });
  if (lines_.size() < blocks_.size()) lines_.resize(blocks_.size());
  const double near_m = view.NearM();
  ParallelFor(blocks_.size(), 0, [&](std::size_t i) {
    const auto& [m, first, last] = blocks_[i];
    const std::span<const glm::dvec3> at = std::span(projected_).subspan(first_vertices_[m]);
    lines_[i].clear();
    for (const OutlineEdge& edge : meshes[m].outline.subspan(first, last - first)) {
      glm::dvec3 a = at[edge.a], b = at[edge.b];
      if (a.z < near_m && b.z < near_m) continue;
      const bool is_seen = TurnOf(a, b, at[edge.corner]) < 0.0;
      if (edge.other_corner != OutlineEdge::kNone) {
        const bool is_other_seen = TurnOf(b, a, at[edge.other_corner]) < 0.0;
        if (is_seen == is_other_seen && !(edge.is_crease && is_seen)) continue;
      } else if (!is_seen) {
        continue;
      }
      if (a.z < near_m) a = AtNear(a, b, near_m);
      if (b.z < near_m) b = AtNear(b, a, near_m);
      lines_[i].push_back({OnScreen(a), OnScreen(b)});
    }
  });
  marks_.Reset(view.width, view.height);
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    for (const Line& line : lines_[i]) marks_.AddLine(line[0], line[1]);
  }
  marks_.KeepWithin(view.within);
  marks_.Number();
}

void ScreenTriangles::FindTriangles(std::span<const DrawnMesh> meshes, const PixelView& view) {
  DivideIntoBlocks(meshes, [](const DrawnMesh& mesh) { return mesh.indices.size() / 3; });
  if (of_blocks_.size() < blocks_.size()) of_blocks_.resize(blocks_.size());
  const double near_m = view.NearM();
  ParallelFor(blocks_.size(), 0, [&](std::size_t i) {
    const auto& [m, first, last] = blocks_[i];
    const DrawnMesh& mesh = meshes[m];
    const std::span<const glm::dvec3> at = std::span(projected_).subspan(first_vertices_[m]);
    of_blocks_[i].clear();
    for (std::size_t t = first; t < last; ++t) {
      const std::uint32_t* index = mesh.indices.data() + 3 * t;
      const Corners corners{at[index[0]], at[index[1]], at[index[2]]};
      const double turn = TurnOf(corners[0], corners[1], corners[2]);
      if (!(turn < 0.0)) continue;
      ScreenTriangle triangle;
      if (!SetPixels(ExtentOf(corners, near_m), view, &triangle) ||
          !marks_.AnyIn(triangle.first, triangle.last) ||
          !SetPlanes(corners, turn, near_m, &triangle)) {
        continue;
      }
      const glm::vec3 a = mesh.positions[index[0]];
      const glm::vec3 across =
          glm::cross(mesh.positions[index[1]] - a, mesh.positions[index[2]] - a);
      triangle.normal = across / std::max(glm::length(across), 1e-30F);
      while (triangle.kind < mesh.ends.size() &&
             3 * t >= static_cast<std::size_t>(mesh.ends[triangle.kind])) {
        ++triangle.kind;
      }
      const bool is_numbered = triangle.kind < mesh.ends.size();
      triangle.component = mesh.components[index[0]];
      triangle.id = is_numbered ? mesh.first_id + static_cast<std::uint32_t>(t) : 0;
      triangle.is_object = mesh.is_object;
      triangle.has_holes = mesh.has_holes;
      of_blocks_[i].push_back(triangle);
    }
  });
  triangles_.clear();
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    triangles_.insert(triangles_.end(), of_blocks_[i].begin(), of_blocks_[i].end());
  }
}

void ScreenTriangles::Project(std::span<const DrawnMesh> meshes, const PixelView& view) {
  ProjectPositions(meshes, view);
  MarkEdges(meshes, view);
  triangles_.clear();
  if (marks_.Count() > 0) FindTriangles(meshes, view);
}

}  // namespace pleinair::compositor
