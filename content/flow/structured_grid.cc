#include "content/flow/structured_grid.h"

#include <algorithm>
#include <limits>

namespace pleinair::content {

Box StructuredGrid::Bounds() const {
  if (!cells.empty()) return cells.bounds();
  return {{axes[0].first_m(), axes[1].first_m(), axes[2].first_m()},
          {axes[0].last_m(), axes[1].last_m(), axes[2].last_m()}};
}

double StructuredGrid::MinCell() const {
  if (!cells.empty()) return cells.min_edge_m();
  double cell_m = std::numeric_limits<double>::infinity();
  for (const GridAxis& axis : axes) {
    if (!axis.flat()) cell_m = std::min(cell_m, axis.min_step_m());
  }
  return cell_m;
}

Vec3 StructuredGrid::Node(int i, int j, int k) const {
  if (!cells.empty()) return cells.Position(i, j, k);
  return {axes[0].Node(i), axes[1].Node(j), axes[2].Node(k)};
}

}  // namespace pleinair::content
