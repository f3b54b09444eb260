#pragma once

#include <array>
#include <cmath>

#include "base/vector.h"

namespace pleinair {

/// A rotation as a Hamilton quaternion. The members are named, because file formats differ in their
/// order.
struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  constexpr bool operator==(const Quaternion&) const = default;
};

constexpr double Dot(const Quaternion& a, const Quaternion& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}

/// Unit quaternion with w >= 0 of a rotation matrix. Divides by the largest component (Shepperd
/// 1978), which keeps it accurate for all angles.
inline Quaternion QuaternionOf(const Mat3& r) {
  const double trace = r(0, 0) + r(1, 1) + r(2, 2);
  std::array<double, 4> q{};
  if (trace >= r(0, 0) && trace >= r(1, 1) && trace >= r(2, 2)) {
    const double w = 0.5 * std::sqrt(1.0 + trace);
    q = {(r(2, 1) - r(1, 2)) / (4 * w), (r(0, 2) - r(2, 0)) / (4 * w),
         (r(1, 0) - r(0, 1)) / (4 * w), w};
  } else {
    const int i = r(0, 0) >= r(1, 1) && r(0, 0) >= r(2, 2) ? 0 : (r(1, 1) >= r(2, 2) ? 1 : 2);
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double largest = 0.5 * std::sqrt(1.0 + r(i, i) - r(j, j) - r(k, k));
    q[i] = largest;
    q[j] = (r(j, i) + r(i, j)) / (4 * largest);
    q[k] = (r(k, i) + r(i, k)) / (4 * largest);
    q[3] = (r(k, j) - r(j, k)) / (4 * largest);
  }
  const double sign = q[3] < 0.0 ? -1.0 : 1.0;
  return {sign * q[0], sign * q[1], sign * q[2], sign * q[3]};
}

/// Rotation matrix of a quaternion of any length except zero.
inline Mat3 RotationOf(const Quaternion& q) {
  const double s = 2.0 / Dot(q, q);
  const double xx = s * q.x * q.x, yy = s * q.y * q.y, zz = s * q.z * q.z;
  const double xy = s * q.x * q.y, xz = s * q.x * q.z, yz = s * q.y * q.z;
  const double wx = s * q.w * q.x, wy = s * q.w * q.y, wz = s * q.w * q.z;
  return {{1 - yy - zz, xy - wz, xz + wy, xy + wz, 1 - xx - zz, yz - wx, xz - wy, yz + wx,
           1 - xx - yy}};
}

}  // namespace pleinair
