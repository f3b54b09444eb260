#include "scene/described_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pleinair::scene {
namespace {

constexpr double kMinExtent_m = 1e-4;

}  // namespace

DescribedSurface GroundSurface(double side_m, double below_m, bool upright) {
  const double half_m = side_m / 2.0;
  DescribedSurface ground;
  ground.name = "ground";
  std::vector<Vec3> corners;
  for (const auto& [x, y] :
       {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
    // Upright: y is up, and z points out of the wall; the order keeps the normal upwards.
    corners.push_back(upright ? Vec3{x * half_m, -below_m, -y * half_m}
                              : Vec3{x * half_m, y * half_m, -below_m});
  }
  ground.polygons.push_back(std::move(corners));
  return ground;
}

Result<DescribedSurface> BoxSurface(Vec3 from, Vec3 to) {
  const Vec3 low{std::min(from.x, to.x), std::min(from.y, to.y), std::min(from.z, to.z)};
  const Vec3 high{std::max(from.x, to.x), std::max(from.y, to.y), std::max(from.z, to.z)};
  if (high.x - low.x < kMinExtent_m || high.y - low.y < kMinExtent_m ||
      high.z - low.z < kMinExtent_m) {
    return InputError("", "has two corners that differ in fewer than three coordinates",
                      "from_m and to_m are opposite corners of a solid box");
  }
  const auto corner = [&](int index) {
    return Vec3{(index & 1) != 0 ? high.x : low.x, (index & 2) != 0 ? high.y : low.y,
                (index & 4) != 0 ? high.z : low.z};
  };
  // Corner numbers have the bits x, y, z; each face counter-clockwise from outside.
  constexpr std::array<std::array<int, 4>, 6> kFaces = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  DescribedSurface box;
  box.kind = SurfaceKind::kBox;
  box.name = "box";
  for (const auto& face : kFaces) {
    std::vector<Vec3>& polygon = box.polygons.emplace_back();
    for (const int index : face) polygon.push_back(corner(index));
  }
  return box;
}

Result<DescribedSurface> WallSurface(std::vector<Vec3> corners) {
  const std::size_t count = corners.size();
  if (count < 3 || count > kMaxWallCorners) {
    return InputError("", "has " + std::to_string(count) + " corners",
                      "give 3 to 64 corners in order, each [x, y, z] in metres");
  }
  // Newell's normal: twice the area, whatever the corners.
  Vec3 normal;
  double size_m = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& a = corners[i];
    const Vec3& b = corners[(i + 1) % count];
    normal = normal + Cross(a - corners[0], b - corners[0]);
    size_m = std::max(size_m, Norm(a - corners[0]));
    if (Norm(b - a) < kMinExtent_m) {
      return InputError("", "has two corners at one place", "leave one of them out");
    }
  }
  const double area = Norm(normal);
  if (area < kMinExtent_m * size_m) {
    return InputError("", "has corners on one line", "give the corners of a plane surface");
  }
  normal = normal * (1.0 / area);
  constexpr double kMaxOffPlane = 0.01;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& a = corners[i];
    const Vec3& b = corners[(i + 1) % count];
    const Vec3& c = corners[(i + 2) % count];
    if (std::abs(Dot(a - corners[0], normal)) > kMaxOffPlane * size_m) {
      return InputError("", "has corners that do not lie in one plane",
                        "divide it into plane walls");
    }
    if (Dot(Cross(b - a, c - b), normal) < 0.0) {
      return InputError("", "has a dent, or corners out of order",
                        "divide it into walls without dents");
    }
  }
  DescribedSurface wall;
  wall.kind = SurfaceKind::kWall;
  wall.name = "wall";
  wall.polygons.push_back(std::move(corners));
  return wall;
}

}  // namespace pleinair::scene
