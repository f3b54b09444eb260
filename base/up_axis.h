#pragma once

#include "base/vector.h"

namespace pleinair {

/// Axis of right-handed coordinates that points up. x points right. The front faces +z if y is up,
/// and −y if z is up.
enum class UpAxis { kY, kZ };

/// Rotation about x that takes coordinates in which `from` is up to those in which `to` is up.
constexpr Mat3 RotationBetween(UpAxis from, UpAxis to) {
  if (from == to) return {};
  return from == UpAxis::kY ? Mat3{{1, 0, 0, 0, 0, -1, 0, 1, 0}}   // (x, −z, y).
                            : Mat3{{1, 0, 0, 0, 0, 1, 0, -1, 0}};  // (x, z, −y).
}

}  // namespace pleinair
