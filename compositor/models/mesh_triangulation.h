#pragma once

#include <cstdint>
#include <vector>

#include "base/vector.h"

namespace pleinair::compositor {

/// Max. corners of a concave polygon, because ear clipping takes quadratic time.
inline constexpr std::size_t kMaxConcaveCorners = 2000;

/// Splits a simple, roughly flat polygon into triangles that keep its winding. A convex polygon
/// becomes a fan; others are split by ear clipping (Meisters 1975). Returns three corner numbers
/// per triangle. The result is empty for fewer than three corners, and for concave polygons with
/// more than kMaxConcaveCorners.
std::vector<std::uint32_t> TriangulatePolygon(const std::vector<Vec3>& corners);

}  // namespace pleinair::compositor
