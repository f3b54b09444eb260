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

GltfPlacement PlacementOf(const tinygltf::Node& node) {
  GltfPlacement placement;
  if (const auto& m = node.matrix; m.size() == 16) {  // Column-major.
    placement.linear = {{m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]}};
    placement.translation_m = {m[12], m[13], m[14]};
    return placement;
  }
  if (const auto& q = node.rotation; q.size() == 4) {
    placement.linear = RotationFromQuaternion(q[0], q[1], q[2], q[3]);
  }
  if (const auto& s = node.scale; s.size() == 3) {
    placement.linear = placement.linear * Mat3{{s[0], 0, 0, 0, s[1], 0, 0, 0, s[2]}};
  }
  if (const auto& t = node.translation; t.size() == 3) {
    placement.translation_m = {t[0], t[1], t[2]};
  }
  return placement;
}

bool IsFinite(const GltfPlacement& placement) {
  const Vec3 t = placement.translation_m;
  double sum = t.x + t.y + t.z;
  for (const double value : placement.linear.m) sum += value;
  return std::isfinite(sum);
}

}  // namespace pleinair::compositor
