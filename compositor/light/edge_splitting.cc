#include "compositor/light/edge_splitting.h"

#include "base/vector.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {
namespace {

using Float3 = std::array<float, 3>;

/// Max. lift relative to the edge: normals of broken files point anywhere.
constexpr double kMaxLift = 0.25;

Float3 ToFloats(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

SurfacePoint EdgeMiddle(const SurfaceMesh& surface, std::uint32_t a, std::uint32_t b) {
  const SurfacePoint from = SurfacePointAt(surface, a), to = SurfacePointAt(surface, b);
  const auto& [x, y, z] = EdgeMidpoint(surface.positions[a], surface.positions[b]);
  SurfacePoint middle{{x, y, z}, from.normal, (from.lift + to.lift) * 0.5};
  // Equal normals stay equal in every bit.
  if (surface.normals[a] == surface.normals[b]) return middle;
  const Vec3 sum = from.normal + to.normal;
  middle.normal = Norm(sum) > 1e-6 ? Normalized(sum) : to.normal;
  const Vec3 edge = to.position - from.position;
  Vec3 bulge = (to.normal * Dot(edge, to.normal) - from.normal * Dot(edge, from.normal)) * 0.25;
  const double limit = kMaxLift * Norm(edge);
  if (const double size = Norm(bulge); size > limit) bulge = bulge * (limit / size);
  middle.lift = middle.lift + bulge;
  return middle;
}

std::uint32_t AddEdgeMiddle(SurfaceMesh* surface, std::uint32_t a, std::uint32_t b) {
  const auto index = static_cast<std::uint32_t>(surface->positions.size());
  const SurfacePoint middle = EdgeMiddle(*surface, a, b);
  surface->positions.push_back(EdgeMidpoint(surface->positions[a], surface->positions[b]));
  surface->normals.push_back(surface->normals[a] == surface->normals[b] ? surface->normals[a]
                                                                        : ToFloats(middle.normal));
  if (!surface->uvs.empty()) {
    const auto uv_a = surface->uvs[a];
    const auto uv_b = surface->uvs[b];
    surface->uvs.push_back({(uv_a[0] + uv_b[0]) * 0.5F, (uv_a[1] + uv_b[1]) * 0.5F});
  }
  if (!surface->details.empty()) {
    surface->details.push_back(Middle(surface->details[a], surface->details[b]));
  }
  if (!surface->lifts.empty() || Dot(middle.lift, middle.lift) > 0.0) {
    surface->lifts.resize(surface->positions.size());
    surface->lifts.back() = ToFloats(middle.lift);
  }
  return index;
}

}  // namespace pleinair::compositor
