#include "compositor/models/gltf_placement.h"

#include <tiny_gltf.h>

#include <cmath>

namespace pleinair::compositor {
namespace {

Mat3 RotationFromQuaternion(double x, double y, double z, double w) {
  const double norm = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(norm > 0.0)) return {};
  x /= norm, y /= norm, z /= norm, w /= norm;
  return {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 2 * (x * y + z * w),
           1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 2 * (x * z - y * w), 2 * (y * z + x * w),
           1 - 2 * (x * x + y * y)}};
}

}  // namespace

GltfPlacement GltfTransform::Placement() const {
  if (matrix) return *matrix;
  const auto& [x, y, z, w] = rotation;
  return {RotationFromQuaternion(x, y, z, w) * Mat3{{scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z}},
          translation_m};
}

GltfTransform TransformOf(const tinygltf::Node& node) {
  GltfTransform transform;
  if (const auto& m = node.matrix; m.size() == 16) {  // Column-major.
    transform.matrix = GltfPlacement{{{m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]}},
                                     {m[12], m[13], m[14]}};
  }
  if (const auto& q = node.rotation; q.size() == 4) transform.rotation = {q[0], q[1], q[2], q[3]};
  if (const auto& s = node.scale; s.size() == 3) transform.scale = {s[0], s[1], s[2]};
  if (const auto& t = node.translation; t.size() == 3) transform.translation_m = {t[0], t[1], t[2]};
  return transform;
}

bool IsFinite(const GltfPlacement& placement) {
  const Vec3 t = placement.translation_m;
  double sum = t.x + t.y + t.z;
  for (const double value : placement.linear.m) sum += value;
  return std::isfinite(sum);
}

std::array<float, 3> TurnedNormal(const Mat3& m, const std::array<float, 3>& n) {
  const Vec3 column0{m(0, 0), m(1, 0), m(2, 0)}, column1{m(0, 1), m(1, 1), m(2, 1)},
      column2{m(0, 2), m(1, 2), m(2, 2)};
  const double sign = Dot(Cross(column0, column1), column2) < 0.0 ? -1.0 : 1.0;
  const Vec3 turned = (Cross(column1, column2) * n[0] + Cross(column2, column0) * n[1] +
                       Cross(column0, column1) * n[2]) *
                      sign;
  const double norm = Norm(turned);
  if (!(norm > 0.0) || !std::isfinite(norm)) return {};
  return {static_cast<float>(turned.x / norm), static_cast<float>(turned.y / norm),
          static_cast<float>(turned.z / norm)};
}

}  // namespace pleinair::compositor
