#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vector.h"
#include "content/flow/curvilinear_cells.h"
#include "content/flow/grid_axis.h"
#include "content/flow/grid_place.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// The nodes of a structured grid: axes for a uniform or rectilinear grid, else positions. Node
/// (i, j, k) has the number i + count₀ (j + count₁ k).
struct StructuredGrid {
  std::array<GridAxis, 3> axes;
  /// Empty, or the positions of a curvilinear grid. The axes then only state the counts.
  CurvilinearCells cells;

  std::array<int, 3> counts() const { return {axes[0].count(), axes[1].count(), axes[2].count()}; }
  std::size_t nodes() const {
    std::size_t product = 1;
    for (const GridAxis& axis : axes) product *= static_cast<std::size_t>(axis.count());
    return product;
  }
  Box Bounds() const;
  double MinCell() const;
  Vec3 Node(int i, int j, int k) const;
};

}  // namespace pleinair::content
