#pragma once

#include "base/vector.h"

namespace pleinair {

// Frames of reference, as types that never have a value (docs/conventions.md has the figure).
struct Camera;  ///< OpenCV: origin at the centre of projection, x right, y down, z forward; metres.
struct Marker;  ///< Origin at the print's centre, x right, y up, z towards the viewer; metres.
struct World;   ///< East, north, up; metres.

/// A point in a named frame of reference, metres.
template <typename Frame>
struct Point {
  Vec3 xyz;
};

/// A direction in a named frame of reference; unit length unless said otherwise.
template <typename Frame>
struct Direction {
  Vec3 xyz;
};

/// Rigid motion that takes coordinates in `From` to coordinates in `To`: x_to = R x_from + t.
/// Named target-from-source: `Transform<Camera, Marker> camera_from_marker`. Composition compiles
/// only where the inner frames match.
template <typename To, typename From>
struct Transform {
  Mat3 rotation;
  Vec3 translation_m;

  Point<To> operator*(Point<From> p) const { return {rotation * p.xyz + translation_m}; }
  Direction<To> operator*(Direction<From> d) const { return {rotation * d.xyz}; }

  template <typename Source>
  Transform<To, Source> operator*(const Transform<From, Source>& from_from_source) const {
    return {rotation * from_from_source.rotation,
            rotation * from_from_source.translation_m + translation_m};
  }

  Transform<From, To> Inverse() const {
    const Mat3 transposed = rotation.Transposed();
    return {transposed, -(transposed * translation_m)};
  }
};

}  // namespace pleinair
