#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compositor/light/gather_origin.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// The middle of an edge. It does not depend on the order of the ends.
inline std::array<float, 3> EdgeMidpoint(const std::array<float, 3>& a,
                                         const std::array<float, 3>& b) {
  return {(a[0] + b[0]) * 0.5F, (a[1] + b[1]) * 0.5F, (a[2] + b[2]) * 0.5F};
}

/// The middle of the edge between two vertices a and b. Its normal is the normalised mean. Its lift
/// is that of Phong tessellation (Boubekeur & Alexa 2008, Eq. 4):
///
///     lift = (lift_a + lift_b) / 2 + (((a − b) · n_a) n_a + ((b − a) · n_b) n_b) / 4
SurfacePoint EdgeMiddle(const SurfaceMesh& surface, std::uint32_t a, std::uint32_t b);

/// Appends the middle of the edge between two vertices and returns it.
std::uint32_t AddEdgeMiddle(SurfaceMesh* surface, std::uint32_t a, std::uint32_t b);

/// Splits the edges for which `is_split(a, b)` holds, a and b being vertices, once in the middle.
/// Triangles become two, three or four. Returns whether any edge was split. Triangles keep their
/// order, and new vertices come after the old ones.
template <typename IsSplit>
bool SplitEdges(SurfaceMesh* surface, const IsSplit& is_split) {
  constexpr std::uint32_t kKeep = ~0U;
  std::unordered_map<std::uint64_t, std::uint32_t> middles;
  const auto middle_of = [&](std::uint32_t a, std::uint32_t b) {
    if (!is_split(a, b)) return kKeep;
    const std::uint64_t key = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    const auto found = middles.find(key);
    if (found != middles.end()) return found->second;
    const std::uint32_t middle = AddEdgeMiddle(surface, a, b);
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
    // Rotates the corners so that a single split is on edge 0, or a single unsplit edge is edge 2.
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

}  // namespace pleinair::compositor
