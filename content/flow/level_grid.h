#pragma once

// Internal: the nodes of levels, and where a point lies among them.

#include <array>
#include <cmath>
#include <cstddef>

#include "base/vector.h"
#include "content/flow/grid_field.h"
#include "content/flow/structured_grid.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// The axes of a field's grid; of other fields and of curvilinear grids, uniform axes with the
/// field's cell over its bounds.
class LevelGrid {
 public:
  explicit LevelGrid(const VectorField& field);

  const std::array<GridAxis, 3>& axes() const { return axes_; }
  std::size_t nodes() const;
  Vec3 Node(std::size_t number) const;
  int dimensions() const { return dimensions_; }

  /// The stencil of a point along one axis, of Catmull and Rom's splines.
  struct Place {
    std::array<int, 3> index{};
    std::array<double, 3> fraction{};
    bool inside = false;
  };
  Place Find(const Vec3& point) const;

  /// The number of the node next to a point, and whether that is on the grid.
  struct Nearest {
    std::size_t node = 0;
    bool inside = false;
  };
  Nearest NearestTo(const Vec3& point) const;

  std::size_t Number(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(axes_[0].count()) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(axes_[1].count()) * static_cast<std::size_t>(k));
  }

 private:
  std::array<GridAxis, 3> axes_;
  int dimensions_ = 0;
};

}  // namespace pleinair::content
