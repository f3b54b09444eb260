#pragma once

#include <array>

namespace pleinair::content {

/// Where a point lies with regard to the cells of a field.
enum class PointState {
  kFlow,     ///< The velocity is known.
  kOutside,  ///< Beyond the border by less than a cell: the border cell's velocities, continued.
  kNoFlow,   ///< In a wall, or farther outside.
};

/// A cell of a structured grid, and the place of a point in it. Unused axes have index 0, fraction
/// 0 and size 1.
struct GridPlace {
  std::array<int, 3> index{};
  std::array<double, 3> fraction{};
  std::array<double, 3> size_m{1.0, 1.0, 1.0};  ///< Of the cell along x, y and z.
};

}  // namespace pleinair::content
