#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {

/// Directions of the final gather about a normal, in an order that suits RayPacket: neighbours are
/// close to each other. Their density is cosine/π. They are the points of ShiftedHammersley() on
/// the unit disc, lifted to the hemisphere (Malley's method; Pharr, Jakob & Humphreys 2016,
/// "Physically Based Rendering", 13.6.3).
class CosineSpread {
 public:
  explicit CosineSpread(std::uint32_t count);

  std::uint32_t count() const { return static_cast<std::uint32_t>(points_.size()); }
  /// Index in Hammersley's set of the direction at this place of the order.
  std::uint32_t RayAt(std::uint32_t place) const { return points_[place].ray; }

  /// The shift of the set by a seed: along its first number, and as an angle about the normal.
  struct Shift {
    double u = 0.0, cosine = 1.0, sine = 0.0;
  };
  static Shift ShiftOf(std::uint32_t seed);

  /// Unit vector in the frame of reference of `frame`; equals CosineDirection() of
  /// ShiftedHammersley() up to rounding.
  Vec3 Direction(const TangentFrame& frame, std::uint32_t place, const Shift& shift) const;

 private:
  struct Point {
    std::uint32_t ray = 0;
    double u = 0.0, cosine = 1.0, sine = 0.0;  // Cosine and sine of the angle about the normal.
  };
  std::vector<Point> points_;
};

}  // namespace pleinair::compositor
