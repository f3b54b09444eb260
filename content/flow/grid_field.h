#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "base/error.h"
#include "content/flow/field_slices.h"
#include "content/flow/structured_grid.h"
#include "content/flow/vector_field.h"

namespace pleinair::content {

/// How velocities are interpolated in space. In time they are linear.
enum class Interpolation {
  kLinear,  ///< Multilinear.
  /// Catmull-Rom splines along each axis; unequal cells by three-point slopes. Quadratic beyond the
  /// border, multilinear where a node of the stencil is a wall.
  kCubic,
};

struct GridFieldOptions {
  Interpolation interpolation = Interpolation::kLinear;
  std::function<Vec3(const Vec3&)> stretch = {};  ///< VectorField::Stretch(); empty: 1.
};

/// The velocities between two times of a field: linear from `first` to `second`. A steady state has
/// the first alone.
struct FieldWindow {
  SharedSlice first, second;
  Seconds first_s = 0.0, second_s = 0.0;

  double WeightAt(Seconds time) const { return (time - first_s) / (second_s - first_s); }
};

/// Velocities at the nodes of a structured grid of 1 to 3 dimensions, at one or several times.
/// Cells with a wall at a corner are walls.
class GridField final : public VectorField {
 public:
  /// `times`: seconds after the first, ascending. Errors (input, without a place): times that do
  /// not ascend.
  static Result<std::shared_ptr<const GridField>> Create(StructuredGrid grid,
                                                         std::vector<Seconds> times,
                                                         FieldSlices::Read slices,
                                                         GridFieldOptions options = {});

  /// A failed read gives no number; WindowAt() has the error.
  Velocity At(const Vec3& point, Seconds time) const override;
  Box bounds() const override { return grid_.Bounds(); }
  double cell_m() const override { return cell_m_; }
  std::span<const Seconds> times() const override { return times_; }
  Vec3 Stretch(const Vec3& point) const override {
    return options_.stretch ? options_.stretch(point) : Vec3{1.0, 1.0, 1.0};
  }

  const StructuredGrid& grid() const { return grid_; }
  Interpolation interpolation() const { return options_.interpolation; }
  bool stretched() const { return static_cast<bool>(options_.stretch); }
  /// Numbers of the axes that are not flat, ascending. In one dimension with a flat one.
  const std::vector<int>& axes() const { return axes_; }

  /// The steady field of a moment. Errors: those of reading.
  Result<FieldWindow> FrozenAt(Seconds time) const;
  /// The window between times() that contains a moment; beyond the ends, the state there. A moment
  /// at a time belongs to the window after it, or before it with `backward`.
  Result<FieldWindow> WindowAt(Seconds time, bool backward = false) const;

 private:
  GridField(StructuredGrid grid, std::vector<Seconds> times, FieldSlices::Read slices,
            GridFieldOptions options);

  StructuredGrid grid_;
  std::vector<Seconds> times_;
  GridFieldOptions options_;
  std::vector<int> axes_;
  double cell_m_;
  mutable FieldSlices slices_;
};

}  // namespace pleinair::content
