#include "compositor/coverage/place_kernels.h"

#include <algorithm>
#include <cstddef>

namespace pleinair::compositor {
namespace {

float ValueAt(const TriangleAtPixel::Plane& plane, float x, float y) {
  return plane[0] + (x * plane[1] + y * plane[2]);
}

void DrawOneByOne(const TriangleAtPixel& triangle, const PlacesOfPixel& places) {
  for (std::size_t i = 0; i < places.x.size(); ++i) {
    const float x = places.x[i], y = places.y[i];
    bool is_inside = true;
    for (std::size_t e = 0; e < 3; ++e) {
      if (!triangle.is_tested[e]) continue;
      const float side = ValueAt(triangle.edges[e], x, y);
      is_inside = is_inside && (triangle.has_edge[e] ? side >= 0.0F : side > 0.0F);
    }
    const float nearness =
        std::clamp(ValueAt(triangle.nearness, x, y), triangle.farthest, triangle.nearest);
    if (is_inside && nearness <= triangle.limit &&
        nearness > places.nearness[i] * (1.0F + kSameDepth)) {
      places.nearness[i] = nearness;
      places.triangles[i] = triangle.number;
    }
  }
}

}  // namespace

DrawAtPlaces ScalarDrawAtPlaces() { return &DrawOneByOne; }

#ifndef PLEINAIR_PLACE_KERNELS_SIMD
DrawAtPlaces FastestDrawAtPlaces() { return ScalarDrawAtPlaces(); }
#endif

}  // namespace pleinair::compositor
