#pragma once

#include <span>

#include "base/vector.h"

namespace pleinair::content {

using Velocity = Vec3;   ///< Metres per second along the axes of the field.
using Seconds = double;  ///< After the first time of the field.

/// An axis-parallel box, metres.
struct Box {
  Vec3 min, max;
};

inline double Diagonal(const Box& box) { return Norm(box.max - box.min); }

/// Velocities in a box of space, at one time or at several. Coordinates are metres of the field's
/// own axes; a field in the plane has one z for all points.
class VectorField {
 public:
  virtual ~VectorField() = default;

  /// The rate of change of the coordinates of a particle at `point`. Times beyond the first and
  /// last are taken as these. Not a number: the point is outside, or in a wall. Thread-safe.
  virtual Velocity At(const Vec3& point, Seconds time) const = 0;

  virtual Box bounds() const = 0;

  /// Size of a cell, the unit of tolerances: the smallest of the grid.
  virtual double cell_m() const = 0;

  /// Ascending; empty or one: steady.
  virtual std::span<const Seconds> times() const = 0;

  /// Metres of the field's axes per true metre, by axis. It differs from 1 where the axes are those
  /// of a map that is not true to scale. True speed is the norm of At() / Stretch(), by component.
  virtual Vec3 Stretch(const Vec3& /*point*/) const { return {1.0, 1.0, 1.0}; }
};

}  // namespace pleinair::content
