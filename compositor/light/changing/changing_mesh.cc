#include "compositor/light/changing/changing_mesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <unordered_set>
#include <utility>

#include "base/parallel_for.h"
#include "compositor/light/edge_splitting.h"
#include "compositor/light/reflectance.h"

namespace pleinair::compositor {
namespace {

using Float3 = std::array<float, 3>;

// Longest edge, as near a still object, and relative to a body's diagonal.
constexpr double kMaxEdge_m = 0.04, kMaxEdgeShare = 1.0 / 48.0;
constexpr std::size_t kMaxSplitVertices = 40'000;
constexpr std::size_t kVerticesPerBlock = 8192;

double DiagonalOf(std::span<const TracedSurface> surfaces) {
  Vec3 low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
  for (const TracedSurface& traced : surfaces) {
    for (const auto& [x, y, z] : traced.surface.positions) {
      low = {std::min<double>(low.x, x), std::min<double>(low.y, y), std::min<double>(low.z, z)};
      high = {std::max<double>(high.x, x), std::max<double>(high.y, y),
              std::max<double>(high.z, z)};
    }
  }
  return low.x > high.x ? 0.0 : Norm(high - low);
}

Float3 NarrowedVector(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// The cofactors of a matrix, times the sign of its determinant: they turn normals.
Mat3 CofactorsOf(const Mat3& m) {
  const Vec3 a{m(0, 0), m(1, 0), m(2, 0)}, b{m(0, 1), m(1, 1), m(2, 1)},
      c{m(0, 2), m(1, 2), m(2, 2)};
  const double sign = Dot(Cross(a, b), c) < 0.0 ? -1.0 : 1.0;
  const Vec3 u = Cross(b, c) * sign, v = Cross(c, a) * sign, w = Cross(a, b) * sign;
  return {{u.x, v.x, w.x, u.y, v.y, w.y, u.z, v.z, w.z}};
}

Float3 UnitVector(Vec3 v) {
  const double norm = Norm(v);
  return norm > 0.0 ? NarrowedVector(v * (1.0 / norm)) : Float3{0.0F, 0.0F, 1.0F};
}

Float3 Opposite(const Float3& v) { return {-v[0], -v[1], -v[2]}; }

}  // namespace

ChangingMesh::ChangingMesh(const PlacedModel& placed, int placed_model)
    : placed_model_(placed_model),
      placed_(placed),
      linear_(placed.linear),
      translation_m_(placed.translation_m) {
  std::vector<TracedSurface> traced = TracedSurfaces(placed, placed_model);
  const Mat3 cofactors = CofactorsOf(placed.linear);
  const double max_edge_m = std::max(kMaxEdge_m, kMaxEdgeShare * DiagonalOf(traced));
  for (TracedSurface& from : traced) {
    Source& source = sources_.emplace_back();
    source.mesh = from.mesh;
    source.reflectance = ReflectanceOf(*placed.model, from.surface.material);
    const std::array<float, 3> mean_color = MeanVertexColor(from.surface);
    for (std::size_t c = 0; c < 3; ++c) source.reflectance[c] *= mean_color[c];
    if (!from.surface.closed) {
      source.transmittance = TransmittanceOf(placed, from.surface.material, source.reflectance);
    }
    source.vertices = std::move(from.vertices);
    const auto& normals = placed.model->meshes[from.mesh].normals;
    for (std::size_t i = 0; i < source.vertices.size(); ++i) {
      const auto& [x, y, z] = normals[source.vertices[i]];
      const auto& [u, v, w] = from.surface.normals[i];
      source.turned.push_back(Dot(cofactors * Vec3{x, y, z}, {u, v, w}) < 0.0);
    }
    Split(max_edge_m, &from.surface, &source);
    from.surface.lifts.clear();
    surfaces_.push_back(std::move(from.surface));
  }
}

void ChangingMesh::Split(double max_edge_m, SurfaceMesh* surface, Source* source) {
  for (bool more = true; more && surface->positions.size() < kMaxSplitVertices;) {
    std::unordered_set<std::uint64_t> split;
    more = SplitEdges(surface, [&](std::uint32_t a, std::uint32_t b) {
      const auto &p = surface->positions[a], &q = surface->positions[b];
      if (std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= max_edge_m) return false;
      // The first call for an edge appends its middle.
      const std::uint64_t edge = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
      if (split.insert(edge).second) source->parents.push_back({a, b});
      return true;
    });
  }
}

void ChangingMesh::Move(const Mat3& linear, Vec3 translation_m) {
  linear_ = linear * placed_.linear;
  translation_m_ = linear * placed_.translation_m + translation_m;
}

bool ChangingMesh::HasTriangles(std::span<const MeshShape> shape) {
  return std::ranges::any_of(shape, [](const MeshShape& mesh) { return !mesh.indices.empty(); });
}

ChangingMesh ChangingMesh::WithTriangles(std::span<const MeshShape> shape) const {
  auto model = std::make_shared<Model>(*placed_.model);
  for (std::size_t i = 0; i < model->meshes.size(); ++i) {
    Mesh& mesh = model->meshes[i];
    if (shape[i].indices.empty()) continue;
    mesh.positions = shape[i].positions;
    mesh.normals = shape[i].normals;
    mesh.indices = shape[i].indices;
    mesh.uvs.clear();
    mesh.details.clear();
  }
  PlacedModel placed = placed_;
  placed.model = std::move(model);
  ChangingMesh other(placed, placed_model_);
  other.linear_ = linear_;
  other.translation_m_ = translation_m_;
  other.SetShape(shape);
  return other;
}

void ChangingMesh::SetShape(std::span<const MeshShape> shape) {
  const Mat3 cofactors = CofactorsOf(linear_);
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    SurfaceMesh& surface = surfaces_[s];
    const Source& source = sources_[s];
    const MeshShape& mesh = shape[source.mesh];
    const std::size_t count = source.vertices.size();
    ParallelFor((count + kVerticesPerBlock - 1) / kVerticesPerBlock, 0, [&](std::size_t block) {
      const std::size_t last = std::min(count, (block + 1) * kVerticesPerBlock);
      for (std::size_t i = block * kVerticesPerBlock; i < last; ++i) {
        const auto& [x, y, z] = mesh.positions[source.vertices[i]];
        const auto& [u, v, w] = mesh.normals[source.vertices[i]];
        surface.positions[i] = NarrowedVector(linear_ * Vec3{x, y, z} + translation_m_);
        const Float3 normal = UnitVector(cofactors * Vec3{u, v, w});
        surface.normals[i] = source.turned[i] ? Opposite(normal) : normal;
      }
    });
    std::size_t next = source.vertices.size();
    for (const auto& [a, b] : source.parents) {
      surface.positions[next] = EdgeMidpoint(surface.positions[a], surface.positions[b]);
      const Float3 &n = surface.normals[a], &m = surface.normals[b];
      surface.normals[next] = UnitVector({n[0] + m[0], n[1] + m[1], n[2] + m[2]});
      ++next;
    }
  }
}

std::vector<LitMesh> ChangingMesh::DrawnMeshes() const {
  // Beyond the numbers that light solvers give.
  static std::atomic<std::uint64_t> geometry{std::uint64_t{1} << 62};
  std::vector<LitMesh> drawn;
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    const SurfaceMesh& surface = surfaces_[s];
    for (const bool back : {false, true}) {
      if (back && surface.closed) continue;
      LitMesh& mesh = drawn.emplace_back();
      mesh.placed_model = placed_model_;
      mesh.material = surface.material;
      mesh.role = surface.role;
      mesh.geometry = geometry++;
      mesh.positions = surface.positions;
      mesh.normals = surface.normals;
      mesh.texturing = {surface.uvs, surface.details, back, sources_[s].reflectance,
                        sources_[s].transmittance};
      mesh.indices = surface.indices;
      mesh.ambient_with.resize(surface.positions.size());
      mesh.sunlight.reflected_with.resize(surface.positions.size());
      if (sources_[s].transmittance != std::array<float, 3>{}) {
        mesh.ambient_without.resize(surface.positions.size());
        mesh.sunlight.reflected_without.resize(surface.positions.size());
      }
      if (!back) continue;
      for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
      }
    }
  }
  CopyShape(drawn);
  return drawn;
}

ChangingMesh::Movement ChangingMesh::CopyShape(std::span<LitMesh> drawn) const {
  Movement movement;
  std::size_t next = 0;
  for (const SurfaceMesh& surface : surfaces_) {
    LitMesh& front = drawn[next++];
    for (std::size_t v = 0; v < surface.positions.size(); ++v) {
      for (std::size_t c = 0; c < 3; ++c) {
        movement.farthest_m = std::max(movement.farthest_m,
                                       std::fabs(surface.positions[v][c] - front.positions[v][c]));
      }
    }
    movement.any = movement.any || movement.farthest_m > 0.0F || front.normals != surface.normals;
    front.positions = surface.positions;
    front.normals = surface.normals;
    if (surface.closed) continue;
    LitMesh& back = drawn[next++];
    back.positions = surface.positions;
    std::ranges::transform(surface.normals, back.normals.begin(), Opposite);
  }
  return movement;
}

}  // namespace pleinair::compositor
