#pragma once

#include <cstdint>
#include <vector>

#include "base/vector.h"

namespace pleinair::compositor {

/// Most corners of a polygon that is not convex; ear clipping takes time by their square.
inline constexpr std::size_t kMaxConcaveCorners = 2000;

/// Splits a simple polygon, roughly flat, into triangles that keep its winding: a fan where it is
/// convex, ears (Meisters 1975) elsewhere. Returns three corner numbers a triangle; empty for
/// fewer than three corners, and for concave ones with more than kMaxConcaveCorners.
std::vector<std::uint32_t> TriangulatePolygon(const std::vector<Vec3>& corners);

}  // namespace pleinair::compositor
