#include "compositor/models/mesh_triangulation.h"

#include <cmath>
#include <numeric>

namespace pleinair::compositor {
namespace {

/// Twice the area vector of a polygon, which may be slightly non-planar. Newell's method;
/// Sutherland et al. 1974.
Vec3 NewellNormal(const std::vector<Vec3>& p) {
  Vec3 normal;
  for (std::size_t i = 0; i < p.size(); ++i) {
    // Relative to the first corner, so that distant polygons lose no precision.
    normal = normal + Cross(p[i] - p[0], p[(i + 1) % p.size()] - p[0]);
  }
  return normal;
}

/// Twice the signed area of a triangle in the projection.
double Area(Vec2 a, Vec2 b, Vec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Projects the polygon along the axis closest to its normal, as seen from its front.
std::vector<Vec2> Project(const std::vector<Vec3>& corners, Vec3 normal) {
  const double x = std::fabs(normal.x), y = std::fabs(normal.y), z = std::fabs(normal.z);
  std::vector<Vec2> flat;
  for (const Vec3 c : corners) {
    const Vec3 p = c - corners[0];
    if (z >= x && z >= y) {
      flat.push_back(normal.z >= 0.0 ? Vec2{p.x, p.y} : Vec2{p.y, p.x});
    } else if (x >= y) {
      flat.push_back(normal.x >= 0.0 ? Vec2{p.y, p.z} : Vec2{p.z, p.y});
    } else {
      flat.push_back(normal.y >= 0.0 ? Vec2{p.z, p.x} : Vec2{p.x, p.z});
    }
  }
  return flat;
}

bool IsConvex(const std::vector<Vec2>& p) {
  double turned = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2 a = p[i], b = p[(i + 1) % p.size()], c = p[(i + 2) % p.size()];
    const double area = Area(a, b, c);
    if (area < 0.0) return false;
    const Vec2 in = b - a, out = c - b;
    turned += std::atan2(area, in.x * out.x + in.y * out.y);
  }
  return turned < 6.5;  // One turn is 2π; a pentagram makes two.
}

bool IsEar(const std::vector<Vec2>& p, const std::vector<std::uint32_t>& left, std::size_t at) {
  const std::size_t n = left.size();
  const Vec2 a = p[left[(at + n - 1) % n]], b = p[left[at]], c = p[left[(at + 1) % n]];
  if (Area(a, b, c) <= 0.0) return false;
  for (const std::uint32_t other : left) {
    const Vec2 q = p[other];
    if (q == a || q == b || q == c) continue;
    if (Area(a, b, q) >= 0.0 && Area(b, c, q) >= 0.0 && Area(c, a, q) >= 0.0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint32_t> TriangulatePolygon(const std::vector<Vec3>& corners) {
  if (corners.size() < 3) return {};
  if (corners.size() == 3) return {0, 1, 2};
  const std::vector<Vec2> flat = Project(corners, NewellNormal(corners));
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> left(corners.size());
  std::iota(left.begin(), left.end(), 0U);
  if (!IsConvex(flat)) {
    if (corners.size() > kMaxConcaveCorners) return {};
    while (left.size() > 3) {
      std::size_t ear = 0;
      while (ear < left.size() && !IsEar(flat, left, ear)) ++ear;
      if (ear == left.size()) break;  // The polygon crosses itself: the rest becomes a fan.
      const std::size_t n = left.size();
      triangles.insert(triangles.end(), {left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
  }
  for (std::size_t i = 1; i + 1 < left.size(); ++i) {
    triangles.insert(triangles.end(), {left[0], left[i], left[i + 1]});
  }
  return triangles;
}

}  // namespace pleinair::compositor
