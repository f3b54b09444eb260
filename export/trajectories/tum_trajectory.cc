#include "export/trajectories/tum_trajectory.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "export/trajectories/text_lines.h"

namespace pleinair::exports {

Result<CameraTrajectory> ParseTum(std::string_view text, const std::string& name) {
  CameraTrajectory path;
  TextLines lines(text, name);
  while (lines.Next()) {
    if (lines.fields().size() != 8) {
      return InputError(lines.Where(),
                        fmt::format("has {} fields instead of 8", lines.fields().size()),
                        "write t_s tx ty tz qx qy qz qw");
    }
    TrajectoryPose pose;
    PLEINAIR_ASSIGN_OR_RETURN(pose.timestamp_ns,
                              NanosecondsFromSeconds(lines.fields()[0], lines.Where()));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> n, lines.Numbers(1, 7));
    const Quaternion turn{.x = n[3], .y = n[4], .z = n[5], .w = n[6]};
    PLEINAIR_ASSIGN_OR_RETURN(
        pose.reference_from_camera,
        (PoseFromFile<Reference, Camera>(lines.Where(), {n[0], n[1], n[2]}, turn)));
    PLEINAIR_RETURN_IF_ERROR(AddPose(lines.Where(), std::move(pose), &path));
  }
  if (path.poses.empty()) return InputError(name, "holds no poses", "get a whole copy of it");
  return path;
}

std::string TumText(const CameraTrajectory& path, std::string_view comment) {
  std::string text = fmt::format("# {}\n", comment);
  for (const TrajectoryPose& pose : path.poses) {
    const Vec3 t = pose.reference_from_camera.translation_m;
    const Quaternion q = QuaternionOf(pose.reference_from_camera.rotation);
    text += fmt::format("{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n",
                        SecondsText(pose.timestamp_ns), t.x, t.y, t.z, q.x, q.y, q.z, q.w);
  }
  return text;
}

}  // namespace pleinair::exports
