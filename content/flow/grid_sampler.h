#pragma once

// Internal: the interpolation of GridField, compiled for its types. The integrator's inner loop.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "content/flow/grid_field.h"
#include "content/flow/grid_place.h"
#include "content/flow/grid_stencil.h"

namespace pleinair::content {

/// Points on uniform and rectilinear axes. In the plane, the two axes that are not flat count.
template <int kDimensions>
class AxisLocator {
 public:
  static constexpr bool kHasPlaneSides = true;
  explicit AxisLocator(const GridField& field) {
    for (std::size_t a = 0; a < kDimensions; ++a) {
      number_[a] = static_cast<std::size_t>(field.axes()[a]);
      axes_[a] = &field.grid().axes[number_[a]];
      const GridAxis& axis = *axes_[a];
      if (!axis.uniform() || axis.flat() || axis.closed()) continue;
      plain_[a] = {axis.first_m(), axis.last_m(), 1.0 / axis.Step(0), axis.Step(0),
                   axis.count() - 2};
    }
  }

  PointState Find(const Vec3& point, GridPlace* place) const {
    const std::array<double, 3> x{point.x, point.y, point.z};
    bool inside = true, near = true;
    for (std::size_t a = 0; a < kDimensions; ++a) {
      const std::size_t n = kDimensions == 3 ? a : number_[a];
      const PlainAxis& plain = plain_[a];
      // Inside a uniform axis, as most points are: without a look at the axis itself.
      if (x[n] >= plain.first_m && x[n] <= plain.last_m) {
        const double at = (x[n] - plain.first_m) * plain.per_step;
        const int index = std::min(static_cast<int>(at), plain.last);
        place->index[a] = index;
        place->fraction[a] = at - index;
        place->size_m[n] = plain.step_m;
        continue;
      }
      const GridAxis& axis = *axes_[a];
      const GridAxis::Place found = axis.Find(x[n], place->index[a]);
      place->index[a] = found.index;
      place->fraction[a] = found.fraction;
      if (axis.flat()) continue;
      place->size_m[n] = axis.Step(found.index);
      inside = inside && axis.Contains(x[n]);
      near = near && found.fraction >= -1.0 && found.fraction <= 2.0;
    }
    return inside ? PointState::kFlow : (near ? PointState::kOutside : PointState::kNoFlow);
  }

  AxisStencil Cubic(const GridPlace& place, std::size_t a) const {
    return HermiteStencil(*axes_[a], place.index[a], place.fraction[a]);
  }

  Vec3 StepSize(const GridPlace& place) const {
    std::array<double, 3> size = place.size_m;
    for (std::size_t a = 0; a < kDimensions; ++a) {
      const GridAxis& axis = *axes_[a];
      const int index = place.index[a];
      if (axis.uniform()) continue;
      double& along = size[kDimensions == 3 ? a : number_[a]];
      if (index > 0) along = std::min(along, axis.Step(index - 1));
      if (index + 2 < axis.count()) along = std::min(along, axis.Step(index + 1));
    }
    return {size[0], size[1], size[2]};
  }

 private:
  /// A uniform axis; empty for others.
  struct PlainAxis {
    double first_m = 1.0, last_m = 0.0, per_step = 0.0, step_m = 0.0;
    int last = 0;
  };

  std::array<const GridAxis*, kDimensions> axes_{};
  std::array<std::size_t, kDimensions> number_{};
  std::array<PlainAxis, kDimensions> plain_{};
};

/// Points in curvilinear cells.
template <int kDimensions>
class CellLocator {
 public:
  static constexpr bool kHasPlaneSides = false;
  explicit CellLocator(const GridField& field)
      : cells_(&field.grid().cells), counts_(field.grid().counts()) {}

  PointState Find(const Vec3& point, GridPlace* place) const {
    if (cells_->Find(point, place)) return PointState::kFlow;
    return std::isnan(place->fraction[0]) ? PointState::kNoFlow : PointState::kOutside;
  }

  AxisStencil Cubic(const GridPlace& place, std::size_t a) const {
    return CatmullRomStencil(place.index[a], place.fraction[a], counts_[a]);
  }

  Vec3 StepSize(const GridPlace& place) const {
    return {place.size_m[0], place.size_m[1], place.size_m[2]};
  }

 private:
  const CurvilinearCells* cells_;
  std::array<int, 3> counts_;
};

/// Interpolates one window of a field. T: the precision of its values. A copy for each thread.
template <typename T, int kDimensions, typename Locator>
class GridSampler {
 public:
  GridSampler(const GridField& field, FieldWindow window)
      : field_(&field),
        locator_(field),
        window_(std::move(window)),
        cubic_(field.interpolation() == Interpolation::kCubic) {
    const std::array<int, 3> counts = field.grid().counts();
    std::array<std::size_t, 3> node_strides{
        1, static_cast<std::size_t>(counts[0]),
        static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1])};
    for (std::size_t a = 0; a < kDimensions; ++a) {
      number_[a] = static_cast<std::size_t>(field.axes()[a]);
      strides_[a] = counts[number_[a]] == 1 ? 0 : node_strides[number_[a]] * kDimensions;
    }
  }

  /// The velocity at a point; `velocity` is set unless there is no flow.
  PointState Sample(const Vec3& point, Seconds time, Vec3* velocity) {
    PointState state = locator_.Find(point, &place_);
    if (state == PointState::kNoFlow) return state;
    std::array<double, kDimensions> v = Value(ValuesOf(*window_.first));
    if (window_.second) {
      const double weight = window_.WeightAt(time);
      const std::array<double, kDimensions> later = Value(ValuesOf(*window_.second));
      for (std::size_t a = 0; a < kDimensions; ++a) v[a] += weight * (later[a] - v[a]);
    }
    if (HasNaN(v)) return PointState::kNoFlow;
    if constexpr (kDimensions == 3) {
      *velocity = {v[0], v[1], v[2]};
    } else {
      std::array<double, 3> all{};
      for (std::size_t a = 0; a < kDimensions; ++a) all[number_[a]] = strides_[a] == 0 ? 0.0 : v[a];
      *velocity = {all[0], all[1], all[2]};
    }
    return state;
  }

  /// Size along x, y and z of the cell that was sampled last, or of the next one if it is smaller.
  Vec3 CellSize() const { return locator_.StepSize(place_); }

  /// The time until a particle crosses a side of the cell that was sampled last, by its velocity
  /// and acceleration. There, multilinear velocities have a kink. A side that is nearer than
  /// kNearSide does not count. Infinite without kinks, and in curvilinear cells.
  double SecondsToSide(const Vec3& velocity, const Vec3& acceleration) const {
    double seconds = std::numeric_limits<double>::infinity();
    if (cubic_ || !Locator::kHasPlaneSides) return seconds;
    const std::array<double, 3> v{velocity.x, velocity.y, velocity.z};
    const std::array<double, 3> a{acceleration.x, acceleration.y, acceleration.z};
    for (std::size_t i = 0; i < kDimensions; ++i) {
      const std::size_t n = kDimensions == 3 ? i : number_[i];
      const double sign = v[n] < 0.0 ? -1.0 : 1.0;
      const double speed = sign * v[n] / place_.size_m[n], gain = sign * a[n] / place_.size_m[n];
      double way = sign > 0.0 ? 1.0 - place_.fraction[i] : place_.fraction[i];
      if (way < kNearSide) way += 1.0;
      // way = speed t + ½ gain t²; a particle that turns before that side reaches the other one.
      const double square = speed * speed + 2.0 * gain * way;
      const double t = square >= 0.0
                           ? 2.0 * way / (speed + std::sqrt(square))
                           : (speed + std::sqrt(speed * speed - 2.0 * gain * (1.0 - way))) / -gain;
      if (t > 0.0 && t < seconds) seconds = t;
    }
    return seconds;
  }

  const VectorField& field() const { return *field_; }
  bool stretched() const { return field_->stretched(); }

 private:
  static constexpr double kNearSide = 0.005;  // Of a cell.
  using Components = std::array<double, kDimensions>;

  static bool HasNaN(const Components& v) {
    double sum = 0.0;
    for (const double component : v) sum += component;
    return std::isnan(sum);
  }

  static const T* ValuesOf(const FieldSlice& slice) {
    if constexpr (sizeof(T) == sizeof(float))
      return slice.singles.data();
    else
      return slice.doubles.data();
  }

  Components Value(const T* values) const {
    if (cubic_) {
      const Components cubic = CubicValue(values);
      if (!HasNaN(cubic)) return cubic;
    }
    const Components linear = LinearValue(values);
    return HasNaN(linear) ? OnBorderOfWall(values) : linear;
  }

  std::size_t CellOffset() const {
    std::size_t offset = 0;
    for (std::size_t a = 0; a < kDimensions; ++a) {
      offset += static_cast<std::size_t>(place_.index[a]) * strides_[a];
    }
    return offset;
  }

  Components LinearValue(const T* values) const {
    const T* const cell = values + CellOffset();
    const double fx = place_.fraction[0], fy = place_.fraction[1];
    const auto at = [](const T* node, std::size_t c) { return static_cast<double>(node[c]); };
    const T *const x1 = cell + strides_[0], *const y1 = cell + strides_[1];
    const T* const xy = y1 + strides_[0];
    Components result;
    if constexpr (kDimensions == 2) {
      for (std::size_t c = 0; c < 2; ++c) {
        const double low = at(cell, c) + fx * (at(x1, c) - at(cell, c));
        const double high = at(y1, c) + fx * (at(xy, c) - at(y1, c));
        result[c] = low + fy * (high - low);
      }
    } else {
      const double fz = place_.fraction[2];
      const std::size_t up = strides_[2];
      for (std::size_t c = 0; c < 3; ++c) {
        const double x00 = at(cell, c) + fx * (at(x1, c) - at(cell, c));
        const double x10 = at(y1, c) + fx * (at(xy, c) - at(y1, c));
        const double x01 = at(cell + up, c) + fx * (at(x1 + up, c) - at(cell + up, c));
        const double x11 = at(y1 + up, c) + fx * (at(xy + up, c) - at(y1 + up, c));
        const double low = x00 + fy * (x10 - x00), high = x01 + fy * (x11 - x01);
        result[c] = low + fz * (high - low);
      }
    }
    return result;
  }

  /// A point exactly on a side of a cell with walls is in the cell beside it, too: corners of
  /// weight 0 do not count.
  Components OnBorderOfWall(const T* values) const {
    Components result{};
    const T* const cell = values + CellOffset();
    for (unsigned corner = 0; corner < 1U << kDimensions; ++corner) {
      double weight = 1.0;
      std::size_t offset = 0;
      for (std::size_t a = 0; a < kDimensions; ++a) {
        const bool upper = (corner >> a & 1U) != 0;
        weight *= upper ? place_.fraction[a] : 1.0 - place_.fraction[a];
        if (upper) offset += strides_[a];
      }
      if (weight == 0.0) continue;
      for (std::size_t c = 0; c < kDimensions; ++c) {
        result[c] += weight * static_cast<double>(cell[offset + c]);
      }
    }
    return result;
  }

  Components CubicValue(const T* values) const {
    std::array<AxisStencil, 3> s;
    s[2].weight[0] = 1.0;
    for (std::size_t a = 0; a < kDimensions; ++a) s[a] = locator_.Cubic(place_, a);
    Components result{};
    for (std::size_t k = 0; k < (kDimensions == 3 ? 4U : 1U); ++k) {
      if (s[2].weight[k] == 0.0) continue;
      for (std::size_t j = 0; j < 4; ++j) {
        const double plane = s[2].weight[k] * s[1].weight[j];
        if (plane == 0.0) continue;
        const T* row = values + static_cast<std::size_t>(s[1].node[j]) * strides_[1];
        if constexpr (kDimensions == 3) row += static_cast<std::size_t>(s[2].node[k]) * strides_[2];
        for (std::size_t i = 0; i < 4; ++i) {
          const double weight = plane * s[0].weight[i];
          if (weight == 0.0) continue;
          const T* const node = row + static_cast<std::size_t>(s[0].node[i]) * strides_[0];
          for (std::size_t c = 0; c < kDimensions; ++c) {
            result[c] += weight * static_cast<double>(node[c]);
          }
        }
      }
    }
    return result;
  }

  const GridField* field_;
  Locator locator_;
  FieldWindow window_;
  bool cubic_;
  std::array<std::size_t, kDimensions> strides_{}, number_{};
  GridPlace place_;
};

}  // namespace pleinair::content
