#include "export/trajectories/euroc_trajectory.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "export/trajectories/text_lines.h"

namespace pleinair::exports {

using devices::EurocBody;

Result<CameraTrajectory> ParseEurocTrajectory(
    std::string_view text, const std::string& name,
    const Transform<EurocBody, Camera>& body_from_camera) {
  CameraTrajectory path;
  TextLines lines(text, name);
  while (lines.Next()) {
    if (lines.fields().size() < 8) {
      return InputError(lines.Where(),
                        fmt::format("has {} columns, fewer than 8", lines.fields().size()),
                        "write timestamp, p_RS_R_x, y, z, q_RS_w, x, y, z");
    }
    TrajectoryPose pose;
    PLEINAIR_ASSIGN_OR_RETURN(pose.timestamp_ns, lines.Integer(0));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> n, lines.Numbers(1, 7));
    const Quaternion turn{.x = n[4], .y = n[5], .z = n[6], .w = n[3]};
    PLEINAIR_ASSIGN_OR_RETURN(
        const auto reference_from_body,
        (PoseFromFile<Reference, EurocBody>(lines.Where(), {n[0], n[1], n[2]}, turn)));
    pose.reference_from_camera = reference_from_body * body_from_camera;
    PLEINAIR_RETURN_IF_ERROR(AddPose(lines.Where(), std::move(pose), &path));
  }
  if (path.poses.empty()) return InputError(name, "holds no poses", "get a whole copy of it");
  return path;
}

std::string EurocTrajectoryText(const CameraTrajectory& path,
                                const Transform<EurocBody, Camera>& body_from_camera) {
  std::string text =
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],q_RS_x [],q_RS_y [],"
      "q_RS_z []\n";
  for (const TrajectoryPose& pose : path.poses) {
    const Transform<Reference, EurocBody> body =
        pose.reference_from_camera * body_from_camera.Inverse();
    const Vec3 t = body.translation_m;
    const Quaternion q = QuaternionOf(body.rotation);
    text += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n", pose.timestamp_ns,
                        t.x, t.y, t.z, q.w, q.x, q.y, q.z);
  }
  return text;
}

}  // namespace pleinair::exports
