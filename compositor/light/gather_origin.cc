#include "compositor/light/gather_origin.h"

#include <algorithm>
#include <cstddef>

namespace pleinair::compositor {
namespace {

Vec3 ToVec3(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

}  // namespace

SurfacePoint SurfacePointAt(const SurfaceMesh& mesh, std::uint32_t vertex) {
  return {ToVec3(mesh.positions[vertex]), ToVec3(mesh.normals[vertex]),
          mesh.lifts.empty() ? Vec3{} : ToVec3(mesh.lifts[vertex])};
}

std::vector<std::array<float, 3>> OutwardLifts(const SurfaceMesh& mesh) {
  std::vector<std::array<float, 3>> lifts = mesh.lifts;
  for (std::uint32_t v = 0; v < lifts.size(); ++v) {
    const Vec3 lift = SurfacePointAt(mesh, v).OutwardLift();
    lifts[v] = {static_cast<float>(lift.x), static_cast<float>(lift.y), static_cast<float>(lift.z)};
  }
  return lifts;
}

std::vector<Vec3> CentresAround(const SurfaceMesh& mesh) {
  std::vector<Vec3> centres(mesh.positions.size());
  std::vector<double> count(mesh.positions.size());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    Vec3 centre;
    for (int c = 0; c < 3; ++c) {
      centre = centre + ToVec3(mesh.positions[mesh.indices[i + c]]) * (1.0 / 3.0);
    }
    for (int c = 0; c < 3; ++c) {
      centres[mesh.indices[i + c]] = centres[mesh.indices[i + c]] + centre;
      ++count[mesh.indices[i + c]];
    }
  }
  for (std::size_t v = 0; v < centres.size(); ++v) {
    centres[v] = count[v] > 0.0 ? centres[v] * (1.0 / count[v]) : ToVec3(mesh.positions[v]);
  }
  return centres;
}

Vec3 GatherOrigin(const SurfacePoint& point, Vec3 centre) {
  constexpr double kPull = 0.1;
  constexpr double kMaxPull_m = 4e-3;
  Vec3 pull = (centre - point.position) * kPull;
  pull = pull - point.normal * std::min(0.0, Dot(pull, point.normal));
  if (const double length = Norm(pull); length > kMaxPull_m) pull = pull * (kMaxPull_m / length);
  return point.position + point.OutwardLift() + pull + point.normal * kRayOffset_m;
}

}  // namespace pleinair::compositor
