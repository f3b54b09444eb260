#pragma once

// Internal: velocities of the nodes from a file's values.

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.h"
#include "content/flow/field_slices.h"
#include "content/flow/files/field_chart.h"
#include "content/flow/files/field_source.h"
#include "content/flow/structured_grid.h"

namespace pleinair::content {

/// How the values of a component, in the file's order, come to the nodes of a field.
class ComponentGrid {
 public:
  /// `strides`: of the file's values along x, y and z.
  ComponentGrid(std::array<FieldAxis, 3> axes, std::array<std::size_t, 3> strides,
                CurvilinearCells cells, FieldChart chart);

  const StructuredGrid& grid() const { return grid_; }

  /// True east and north become components along the axes of a projected map.
  void TurnFromEast(GridConvergence convergence) { convergence_ = std::move(convergence); }

  /// A slice of components along x, y and z in metres per second; a missing one counts as zero.
  /// `in_double`: the precision of the slice.
  FieldSlice Combine(const std::array<const std::vector<double>*, 3>& components,
                     bool in_double) const;

 private:
  StructuredGrid grid_;
  std::array<std::vector<int>, 3> source_;
  std::array<std::size_t, 3> strides_;
  FieldChart chart_;
  std::optional<GridConvergence> convergence_;
};

/// The field of a file: checks its size and makes it.
Result<FlowFile> MakeFlowFile(std::shared_ptr<const ComponentGrid> components,
                              std::vector<Seconds> times, FieldSlices::Read slices,
                              const FieldChart& chart, const FlowFileOptions& options);

}  // namespace pleinair::content
