#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace pleinair {

/// Bilinear value of a grid between its nodes, as GL_LINEAR with GL_CLAMP_TO_EDGE takes it.
/// `values`: row by row, `width` × `height` > 0. `x`, `y`: in nodes from the first; clamped to the
/// grid.
inline double BilinearAt(std::span<const float> values, int width, int height, double x, double y) {
  const double column = std::clamp(x, 0.0, width - 1.0), row = std::clamp(y, 0.0, height - 1.0);
  const int left = static_cast<int>(column), top = static_cast<int>(row);
  const auto node = [&](int i, int j) {
    const auto line = static_cast<std::size_t>(std::min(j, height - 1));
    return static_cast<double>(values[line * static_cast<std::size_t>(width) +
                                      static_cast<std::size_t>(std::min(i, width - 1))]);
  };
  const double u = column - left, v = row - top;
  return (1 - v) * ((1 - u) * node(left, top) + u * node(left + 1, top)) +
         v * ((1 - u) * node(left, top + 1) + u * node(left + 1, top + 1));
}

}  // namespace pleinair
