#include "compositor/light/tessellation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "compositor/light/contact_edges.h"
#include "compositor/light/edge_splitting.h"
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
  bool TooLong(const std::array<float, 3>& a, const std::array<float, 3>& b) const {
    const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    if (length <= lengths_.near_m) return false;
    const std::array<float, 3> middle = EdgeMidpoint(a, b);
    const double open = lengths_.InSunlight(middle);
    if (length > open) return true;
    // At a contact the limit is a fraction of that; it grows with the distance.
    const double finest = lengths_.AtContact(open);
    return length > finest && contacts_.IsWithin(middle, (length - finest) / kContactGrowth);
  }

  bool RefineOnce(SurfaceMesh* surface) const {
    return SplitEdges(surface, [&](std::uint32_t a, std::uint32_t b) {
      return TooLong(surface->positions[a], surface->positions[b]);
    });
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
