#include "content/draping/surface_index.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace pleinair::content {
namespace {

constexpr double kMaxCoordinate_m = 1e7;
constexpr double kVertical_rad = 1e-6;

Vec2 InPlan(const Vec3& v) { return {v.x, v.y}; }

double CrossOf(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// The height of a triangle's plane at a place in it, or on its border within kOnLine_m.
std::optional<double> HeightInside(const std::array<Vec3, 3>& corners, Vec2 at) {
  std::array<double, 3> share{};
  double sum = 0.0;
  const double area = CrossOf(InPlan(corners[1] - corners[0]), InPlan(corners[2] - corners[0]));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 from = InPlan(corners[(i + 1) % 3]), to = InPlan(corners[(i + 2) % 3]);
    share[i] = CrossOf(to - from, at - from) * (area < 0.0 ? -1.0 : 1.0);
    if (share[i] < -kOnLine_m * Norm(to - from)) return std::nullopt;
    share[i] = std::max(share[i], 0.0);
    sum += share[i];
  }
  if (!(sum > 0.0)) return std::nullopt;
  return (corners[0].z * share[0] + corners[1].z * share[1] + corners[2].z * share[2]) / sum;
}

bool IsPlace(const Vec3& v) {
  return std::fabs(v.x) <= kMaxCoordinate_m && std::fabs(v.y) <= kMaxCoordinate_m &&
         std::fabs(v.z) <= kMaxCoordinate_m;
}

bool StandsUpright(const std::array<Vec3, 3>& corners) {
  const Vec3 normal = Cross(corners[1] - corners[0], corners[2] - corners[0]);
  return std::fabs(normal.z) <= kVertical_rad * Norm(normal);
}

}  // namespace

SurfaceIndex::SurfaceIndex(SurfaceMesh mesh, PlanTree tree, std::vector<bool> vertical)
    : mesh_(std::move(mesh)), tree_(std::move(tree)), vertical_(std::move(vertical)) {}

Result<SurfaceIndex> SurfaceIndex::Create(SurfaceMesh mesh) {
  for (const Point<World>& vertex : mesh.vertices) {
    if (IsPlace(vertex.xyz)) continue;
    return InputError("", "a surface has a vertex that is no place near the marker",
                      "give its coordinates in metres from the marker");
  }
  if (mesh.surfaces.size() != mesh.triangles.size()) {
    return InputError("", "a surface has triangles that belong to none");
  }
  std::vector<PlanBox> boxes;
  boxes.reserve(mesh.triangles.size());
  std::vector<bool> vertical;
  vertical.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      if (triangle[i] >= mesh.vertices.size()) {
        return InputError("", "a surface has a triangle with a vertex that does not exist");
      }
      corners[i] = mesh.vertices[triangle[i]].xyz;
    }
    PlanBox box{InPlan(corners[0]), InPlan(corners[0])};
    box.Include(InPlan(corners[1]));
    box.Include(InPlan(corners[2]));
    boxes.push_back(box);
    vertical.push_back(StandsUpright(corners));
  }
  return SurfaceIndex(std::move(mesh), PlanTree(boxes), std::move(vertical));
}

std::optional<double> SurfaceIndex::HeightAt(Vec2 east_north, const SurfaceRule& rule) const {
  std::optional<double> chosen;
  tree_.VisitAlong(east_north, east_north, kOnLine_m, [&](std::uint32_t triangle) {
    if (vertical_[triangle] || !rule.Allows(mesh_.surfaces[triangle])) return;
    const std::optional<double> height = HeightInside(Corners(triangle), east_north);
    if (height && (!chosen || rule.Prefers(*height, *chosen))) chosen = height;
  });
  return chosen;
}

void SurfaceIndex::TrianglesAlong(Vec2 a, Vec2 b, std::vector<std::uint32_t>* triangles) const {
  triangles->clear();
  tree_.VisitAlong(a, b, kOnLine_m, [&](std::uint32_t i) { triangles->push_back(i); });
  std::sort(triangles->begin(), triangles->end());
}

}  // namespace pleinair::content
