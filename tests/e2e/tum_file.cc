#include "tests/e2e/tum_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "base/quaternion.h"
#include "base/units.h"

namespace pleinair::e2e {
namespace {

double Angle(const Mat3& a, const Mat3& b) {
  const Mat3 turn = a.Transposed() * b;
  const Vec3 twice_sine{turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)};
  return std::atan2(Norm(twice_sine), turn(0, 0) + turn(1, 1) + turn(2, 2) - 1.0);
}

}  // namespace

std::vector<TumPose> ReadTum(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<TumPose> poses;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    TumPose pose;
    Vec3& t = pose.marker_from_camera.translation_m;
    Quaternion q;
    fields >> pose.time_s >> t.x >> t.y >> t.z >> q.x >> q.y >> q.z >> q.w;
    pose.marker_from_camera.rotation = RotationOf(q);
    poses.push_back(pose);
  }
  return poses;
}

const TumPose* PoseAt(const std::vector<TumPose>& poses, double time_s) {
  const auto found = std::find_if(poses.begin(), poses.end(), [&](const TumPose& pose) {
    return std::abs(pose.time_s - time_s) < 1e-6;
  });
  return found == poses.end() ? nullptr : &*found;
}

PoseError ErrorOf(const TumPose& found, const TumPose& truth) {
  const auto& a = found.marker_from_camera;
  const auto& b = truth.marker_from_camera;
  const double distance = Norm(b.translation_m);
  return {ToDegrees(Radians(Angle(a.rotation, b.rotation))),
          Norm(a.translation_m - b.translation_m) / distance,
          Norm(a.Inverse().translation_m - b.Inverse().translation_m) / distance};
}

double Percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], place - static_cast<double>(below));
}

}  // namespace pleinair::e2e
