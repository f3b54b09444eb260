#include "compositor/light/tessellation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "compositor/light/contact_edges.h"
#include "compositor/light/object_distance.h"

namespace pleinair::compositor {
namespace {

// Length of edges at contacts relative to edges elsewhere, and its increase per metre of distance
// from the contact.
constexpr double kContactShare = 0.35, kContactGrowth = 0.8;

/// Max. edge length at a point, metres.
struct EdgeLengths {
  const ObjectDistance& distance;
  double near_m;
  double growth_per_m;

  double InSunlight(const std::array<float, 3>& point) const {
    return near_m + growth_per_m * distance(point);
  }
  double AtContact(double in_sunlight) const {
    return std::max(near_m, kContactShare * in_sunlight);
  }
};

class Refiner {
 public:
  Refiner(const EdgeLengths& lengths, const ContactEdges& contacts)
      : lengths_(lengths), contacts_(contacts) {}

  /// Splits until every edge fits. Returns false if that needs more than `max_vertices`.
  bool Refine(SurfaceMesh* surface, std::size_t max_vertices) const {
    // Each pass halves the edges that are too long; 40 passes reduce any length below any
    // precision.
    for (int pass = 0; pass < 40; ++pass) {
      if (!RefineOnce(surface)) return true;
      if (surface->positions.size() > max_vertices) return false;
    }
    return true;
  }

 private:
  static std::array<float, 3> Midpoint(const std::array<float, 3>& a,
                                       const std::array<float, 3>& b) {
    return {(a[0] + b[0]) * 0.5F, (a[1] + b[1]) * 0.5F, (a[2] + b[2]) * 0.5F};
  }

  bool TooLong(const std::array<float, 3>& a, const std::array<float, 3>& b) const {
    const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    if (length <= lengths_.near_m) return false;
    const std::array<float, 3> middle = Midpoint(a, b);
    const double open = lengths_.InSunlight(middle);
    if (length > open) return true;
    // At a contact the limit is a fraction of that; it grows with the distance.
    const double finest = lengths_.AtContact(open);
    return length > finest && contacts_.IsWithin(middle, (length - finest) / kContactGrowth);
  }

  static std::uint32_t AddMidpoint(SurfaceMesh* surface, std::uint32_t a, std::uint32_t b) {
    const auto index = static_cast<std::uint32_t>(surface->positions.size());
    surface->positions.push_back(Midpoint(surface->positions[a], surface->positions[b]));
    std::array<float, 3> normal = surface->normals[a];
    const std::array<float, 3>& other = surface->normals[b];
    if (normal != other) {
      for (int i = 0; i < 3; ++i) normal[i] += other[i];
      const float norm = std::hypot(normal[0], normal[1], normal[2]);
      for (int i = 0; i < 3; ++i) normal[i] = norm > 1e-6F ? normal[i] / norm : other[i];
    }
    surface->normals.push_back(normal);
    if (!surface->uvs.empty()) {
      const auto& uv_a = surface->uvs[a];
      const auto& uv_b = surface->uvs[b];
      surface->uvs.push_back({(uv_a[0] + uv_b[0]) * 0.5F, (uv_a[1] + uv_b[1]) * 0.5F});
    }
    return index;
  }

  bool RefineOnce(SurfaceMesh* surface) const {
    constexpr std::uint32_t kKeep = ~0U;
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    const auto middle_of = [&](std::uint32_t a, std::uint32_t b) {
      if (!TooLong(surface->positions[a], surface->positions[b])) return kKeep;
      const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
      const auto found = middles.find(key);
      if (found != middles.end()) return found->second;
      const std::uint32_t middle = AddMidpoint(surface, a, b);
      middles.emplace(key, middle);
      return middle;
    };
    std::vector<std::uint32_t> refined;
    refined.reserve(surface->indices.size());
    const auto emit = [&refined](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      refined.insert(refined.end(), {a, b, c});
    };
    bool changed = false;
    for (std::size_t t = 0; t + 2 < surface->indices.size(); t += 3) {
      std::array<std::uint32_t, 3> v{surface->indices[t], surface->indices[t + 1],
                                     surface->indices[t + 2]};
      std::array<std::uint32_t, 3> m{middle_of(v[0], v[1]), middle_of(v[1], v[2]),
                                     middle_of(v[2], v[0])};
      const int splits = (m[0] != kKeep) + (m[1] != kKeep) + (m[2] != kKeep);
      changed = changed || splits > 0;
      // Rotates the corners so that a single split is on edge 0, or a single unsplit edge is edge
      // 2.
      while ((splits == 1 && m[0] == kKeep) || (splits == 2 && m[2] != kKeep)) {
        std::rotate(v.begin(), v.begin() + 1, v.end());
        std::rotate(m.begin(), m.begin() + 1, m.end());
      }
      switch (splits) {
        case 0:
          emit(v[0], v[1], v[2]);
          break;
        case 1:
          emit(v[0], m[0], v[2]);
          emit(m[0], v[1], v[2]);
          break;
        case 2:
          emit(m[0], v[1], m[1]);
          emit(v[0], m[0], m[1]);
          emit(v[0], m[1], v[2]);
          break;
        default:
          emit(v[0], m[0], m[2]);
          emit(m[0], v[1], m[1]);
          emit(m[2], m[1], v[2]);
          emit(m[0], m[1], m[2]);
      }
    }
    surface->indices = std::move(refined);
    return changed;
  }

  const EdgeLengths& lengths_;
  const ContactEdges& contacts_;
};

std::size_t CountVertices(const std::vector<SurfaceMesh>& surfaces) {
  std::size_t count = 0;
  for (const SurfaceMesh& surface : surfaces) count += surface.positions.size();
  return count;
}

/// Returns false and keeps `surfaces` if that needs more than `max_vertices`.
bool RefineAll(const Refiner& refiner, std::size_t max_vertices,
               std::vector<SurfaceMesh>* surfaces) {
  std::vector<SurfaceMesh> refined = *surfaces;
  std::size_t used = 0;
  for (SurfaceMesh& surface : refined) {
    if (used >= max_vertices || !refiner.Refine(&surface, max_vertices - used)) return false;
    used += surface.positions.size();
  }
  *surfaces = std::move(refined);
  return true;
}

}  // namespace

void Tessellate(const TessellationOptions& options, std::vector<SurfaceMesh>* surfaces) {
  if (CountVertices(*surfaces) >= options.max_vertices) return;
  const ObjectDistance distance(*surfaces);
  EdgeLengths lengths{distance, options.near_edge_m, options.growth_per_m};
  const ContactEdges contacts(*surfaces, [&lengths](const std::array<float, 3>& point) {
    return lengths.AtContact(lengths.InSunlight(point));
  });
  if (RefineAll({lengths, contacts}, options.max_vertices, surfaces)) return;
  // Contacts do not justify coarser triangles everywhere else.
  const ContactEdges none;
  for (int coarser = 0; coarser < 34; ++coarser) {  // Up to a factor of a million.
    if (RefineAll({lengths, none}, options.max_vertices, surfaces)) return;
    lengths.near_m *= 1.5;
    lengths.growth_per_m *= 1.5;
  }
}

}  // namespace pleinair::compositor
