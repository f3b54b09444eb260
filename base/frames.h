#pragma once

#include "base/vector.h"

namespace pleinair {

// Frames of reference, as tag types that have no values (figure: docs/conventions.md).
struct Camera;  ///< OpenCV: origin at the centre of projection, x right, y down, z forward; metres.
struct Marker;  ///< Origin at the marker's centre, x right, y up, z towards the viewer; metres.
struct World;   ///< East, north, up; metres.

/// A point in the frame of reference `Frame`, metres.
template <typename Frame>
struct Point {
  Vec3 xyz;
};

/// A direction in the frame of reference `Frame`; unit length unless documented otherwise.
template <typename Frame>
struct Direction {
  Vec3 xyz;
};

/// Rigid transform of coordinates: x_to = R x_from + t. Named target-from-source:
/// `Transform<Camera, Marker> camera_from_marker`. A composition compiles only if the inner frames
/// match.
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
