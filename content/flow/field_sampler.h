#pragma once

// Internal: chooses the compiled sampler of a field.

#include <cmath>
#include <limits>
#include <utility>

#include "content/flow/grid_sampler.h"

namespace pleinair::content {

/// Any field, by its virtual functions, as a sampler like GridSampler. Frozen at the first time of
/// the window where that has no second slice; see FlowMoment.
class AnyFieldSampler {
 public:
  AnyFieldSampler(const VectorField& field, bool frozen, Seconds frozen_s)
      : field_(&field), frozen_(frozen), frozen_s_(frozen_s) {}

  PointState Sample(const Vec3& point, Seconds time, Vec3* velocity) {
    *velocity = field_->At(point, frozen_ ? frozen_s_ : time);
    if (std::isnan(velocity->x + velocity->y + velocity->z)) return PointState::kNoFlow;
    const Box box = field_->bounds();
    const auto in = [](double x, double low, double high) { return x >= low && x <= high; };
    const bool inside = in(point.x, box.min.x, box.max.x) && in(point.y, box.min.y, box.max.y) &&
                        in(point.z, box.min.z, box.max.z);
    return inside ? PointState::kFlow : PointState::kOutside;
  }
  Vec3 CellSize() const { return {field_->cell_m(), field_->cell_m(), field_->cell_m()}; }
  double SecondsToSide(const Vec3& /*velocity*/, const Vec3& /*acceleration*/) const {
    return std::numeric_limits<double>::infinity();
  }
  const VectorField& field() const { return *field_; }
  bool stretched() const { return true; }

 private:
  const VectorField* field_;
  bool frozen_;
  Seconds frozen_s_;
};

/// Calls `body` with the sampler of a grid.
template <typename Body>
auto WithGridSampler(const GridField& field, const FieldWindow& window, const Body& body) {
  const auto with_locator = [&]<typename T, int kDimensions>() {
    if (field.grid().cells.empty()) {
      return body(GridSampler<T, kDimensions, AxisLocator<kDimensions>>(field, window));
    }
    return body(GridSampler<T, kDimensions, CellLocator<kDimensions>>(field, window));
  };
  const bool single = window.first->doubles.empty();
  if (field.axes().size() == 3) {
    return single ? with_locator.template operator()<float, 3>()
                  : with_locator.template operator()<double, 3>();
  }
  return single ? with_locator.template operator()<float, 2>()
                : with_locator.template operator()<double, 2>();
}

}  // namespace pleinair::content
