#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "content/flow/grid_place.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// The cells of a curvilinear structured grid. Within a cell, positions are multilinear in the
/// fractions of the cell; a point is found by Newton's method. Grids in the plane extend along the
/// first two axes and x and y; z does not count.
class CurvilinearCells {
 public:
  CurvilinearCells() = default;
  /// `positions`: of all nodes, the first axis fastest. Error (input, without a place): fewer than
  /// two nodes along one of the first two axes, positions that are not finite, or no extent.
  static Result<CurvilinearCells> Create(std::array<int, 3> counts, std::vector<Vec3> positions);

  bool empty() const { return !parts_; }
  Box bounds() const;
  double min_edge_m() const;  ///< The shortest edge of a cell that is not collapsed.
  Vec3 Position(int i, int j, int k) const;

  /// The cell of a point. Starts at the cell in `place`, then searches. Returns false if the point
  /// is in no cell; `place` then holds the last border cell of the search, with fractions beyond
  /// [0, 1].
  bool Find(const Vec3& point, GridPlace* place) const;

 private:
  struct Parts;
  explicit CurvilinearCells(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

  std::shared_ptr<const Parts> parts_;
};

}  // namespace pleinair::content
