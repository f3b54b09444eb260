#include "export/trajectories/stray_trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "export/trajectories/text_lines.h"

namespace pleinair::exports {
namespace {

constexpr std::array<std::string_view, 9> kStrayColumns{"timestamp", "frame", "x",  "y", "z",
                                                        "qx",        "qy",    "qz", "qw"};

bool HasStrayColumns(const std::vector<std::string_view>& fields) {
  return fields.size() >= kStrayColumns.size() &&
         std::equal(kStrayColumns.begin(), kStrayColumns.end(), fields.begin());
}

}  // namespace

bool IsStrayOdometry(std::string_view text) {
  TextLines lines(text, "");
  return lines.Next() && HasStrayColumns(lines.fields());
}

Result<CameraTrajectory> ParseStrayOdometry(std::string_view text, const std::string& name) {
  TextLines lines(text, name);
  if (!lines.Next() || !HasStrayColumns(lines.fields())) {
    return InputError(name,
                      "is no odometry.csv of Stray Scanner: it lacks the header timestamp, frame, "
                      "x, y, z, qx, qy, qz, qw",
                      "record with a version that writes times, or name the right file");
  }
  CameraTrajectory path;
  while (lines.Next()) {
    TrajectoryPose pose;
    if (lines.fields().size() < kStrayColumns.size()) {
      return InputError(lines.Where(),
                        fmt::format("has {} fields, fewer than 9", lines.fields().size()),
                        "get a whole copy of the file");
    }
    PLEINAIR_ASSIGN_OR_RETURN(pose.timestamp_ns,
                              NanosecondsFromSeconds(lines.fields()[0], lines.Where()));
    PLEINAIR_ASSIGN_OR_RETURN(pose.frame, lines.Integer(1));
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> n, lines.Numbers(2, 7));
    const Quaternion turn{.x = n[3], .y = n[4], .z = n[5], .w = n[6]};
    PLEINAIR_ASSIGN_OR_RETURN(
        pose.reference_from_camera,
        (PoseFromFile<Reference, Camera>(lines.Where(), {n[0], n[1], n[2]}, turn)));
    if (!path.poses.empty() && pose.frame <= path.poses.back().frame) {
      return InputError(lines.Where(), "has a frame number that does not ascend",
                        "get a whole copy of the file");
    }
    PLEINAIR_RETURN_IF_ERROR(AddPose(lines.Where(), std::move(pose), &path));
  }
  if (path.poses.empty()) return InputError(name, "holds no poses", "get a whole copy of it");
  return path;
}

Result<std::optional<CameraModel>> ParseStrayCamera(std::string_view text,
                                                    const std::string& name) {
  std::vector<double> matrix;
  TextLines lines(text, name);
  while (lines.Next()) {
    if (lines.fields().size() != 3 || matrix.size() == 9) {
      return InputError(lines.Where(), "is no line of a 3×3 matrix",
                        "get a whole copy of the file");
    }
    PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> row, lines.Numbers(0, 3));
    matrix.insert(matrix.end(), row.begin(), row.end());
  }
  if (matrix.size() != 9) {
    return InputError(name, "holds no 3×3 matrix", "get a whole copy of the file");
  }
  constexpr int kWidth = 1920, kHeight = 1440;
  CameraModel camera;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.fx = matrix[0];
  camera.fy = matrix[4];
  camera.cx = matrix[2] - 0.5;
  camera.cy = matrix[5] - 0.5;
  constexpr double kNear = 0.1;
  const bool is_of_size = std::abs(matrix[2] - 0.5 * kWidth) < kNear * kWidth &&
                          std::abs(matrix[5] - 0.5 * kHeight) < kNear * kHeight;
  if (!is_of_size || !(camera.fx > 0.0 && camera.fy > 0.0)) return std::nullopt;
  return camera;
}

}  // namespace pleinair::exports
