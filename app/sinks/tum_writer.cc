#include "app/sinks/tum_writer.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/atomic_file.h"

namespace pleinair::app {
namespace {

/// x, y, z, w of a rotation, by its largest component (Shepperd 1978), so that no small difference
/// is divided by.
std::array<double, 4> QuaternionOf(const Mat3& r) {
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
  if (q[3] < 0.0) {
    for (double& component : q) component = -component;
  }
  return q;
}

}  // namespace

std::string TumText(const std::vector<Observation>& path) {
  std::string text =
      "# camera in the marker frame: t_s tx ty tz qx qy qz qw (x_marker = R(q) x_camera + t)\n";
  for (const Observation& at : path) {
    const Transform<Marker, Camera> marker_from_camera = at.camera_from_marker.Inverse();
    const Vec3 t = marker_from_camera.translation_m;
    const auto q = QuaternionOf(marker_from_camera.rotation);
    text += fmt::format("{:.6f} {:.8f} {:.8f} {:.8f} {:.8f} {:.8f} {:.8f} {:.8f}\n",
                        static_cast<double>(at.timestamp_ns) * 1e-9, t.x, t.y, t.z, q[0], q[1],
                        q[2], q[3]);
  }
  return text;
}

Result<void> WriteTum(const std::filesystem::path& file, const std::vector<Observation>& path) {
  return WriteFileAtomically(file, TumText(path));
}

}  // namespace pleinair::app
