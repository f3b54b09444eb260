#include "app/accuracy/recording_truth.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "accuracy/scoring.h"
#include "accuracy/statistics.h"
#include "devices/recordings/euroc.h"
#include "export/trajectories/trajectory_files.h"
#include "files/text_file.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

bool IsFile(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

Result<RecordingTruth> ReadTum(const fs::path& file, bool in_marker_frame) {
  PLEINAIR_ASSIGN_OR_RETURN(exports::CameraTrajectory path,
                            exports::ReadTrajectory(file, exports::TrajectoryFormat::kTum, {}));
  return RecordingTruth{std::move(path.poses), in_marker_frame};
}

Result<RecordingTruth> ReadEuroc(const fs::path& file, const fs::path& sensor) {
  exports::TrajectoryReading reading;
  if (IsFile(sensor)) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::string yaml,
                              files::ReadWholeFile(sensor, files::kMaxCalibrationBytes));
    PLEINAIR_ASSIGN_OR_RETURN(reading.body_from_camera,
                              devices::ParseEurocExtrinsics(yaml, sensor.string()));
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      exports::CameraTrajectory path,
      exports::ReadTrajectory(file, exports::TrajectoryFormat::kEuroc, reading));
  return RecordingTruth{std::move(path.poses), false};
}

Quaternion Weighted(const Quaternion& a, double weight_a, const Quaternion& b, double weight_b) {
  // q and -q are the same rotation: take the nearer one.
  const double w = Dot(a, b) < 0.0 ? -weight_b : weight_b;
  return {weight_a * a.x + w * b.x, weight_a * a.y + w * b.y, weight_a * a.z + w * b.z,
          weight_a * a.w + w * b.w};
}

Transform<exports::Reference, Camera> Between(const exports::TrajectoryPose& before,
                                              const exports::TrajectoryPose& after,
                                              std::int64_t timestamp_ns) {
  const double share = static_cast<double>(timestamp_ns - before.timestamp_ns) /
                       static_cast<double>(after.timestamp_ns - before.timestamp_ns);
  const auto &a = before.reference_from_camera, &b = after.reference_from_camera;
  return {
      RotationOf(Weighted(QuaternionOf(a.rotation), 1.0 - share, QuaternionOf(b.rotation), share)),
      a.translation_m * (1.0 - share) + b.translation_m * share};
}

}  // namespace

Result<RecordingTruth> ReadRecordingTruth(const fs::path& recording) {
  if (IsFile(recording / "truth.tum")) return ReadTum(recording / "truth.tum", true);
  if (IsFile(recording / "groundtruth.txt")) return ReadTum(recording / "groundtruth.txt", false);
  for (const fs::path& camera : {recording / "mav0" / "cam0", recording / "cam0", recording}) {
    const fs::path file =
        camera.lexically_normal() / ".." / "state_groundtruth_estimate0" / "data.csv";
    if (IsFile(camera / "data.csv") && IsFile(file)) return ReadEuroc(file, camera / "sensor.yaml");
  }
  return InputError(recording.string(), "has no ground truth",
                    "put truth.tum beside its frames, the camera in the marker's frame "
                    "(or groundtruth.txt, or EuRoC's state_groundtruth_estimate0/data.csv)");
}

std::optional<Transform<exports::Reference, Camera>> PoseAt(
    const std::vector<exports::TrajectoryPose>& poses, std::int64_t timestamp_ns,
    std::int64_t period_ns) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), timestamp_ns,
                                      [](const exports::TrajectoryPose& pose, std::int64_t time) {
                                        return pose.timestamp_ns < time;
                                      });
  const bool has_before = after != poses.begin(), has_after = after != poses.end();
  const std::int64_t to_before = has_before ? timestamp_ns - (after - 1)->timestamp_ns : 0;
  const std::int64_t to_after = has_after ? after->timestamp_ns - timestamp_ns : 0;
  if (has_before && has_after && to_before <= period_ns && to_after <= period_ns) {
    return Between(*(after - 1), *after, timestamp_ns);
  }
  const std::int64_t reach_ns = period_ns / 4;
  if (has_after && to_after <= reach_ns) return after->reference_from_camera;
  if (has_before && to_before <= reach_ns) return (after - 1)->reference_from_camera;
  return std::nullopt;
}

std::optional<Transform<Marker, exports::Reference>> AlignReference(
    const std::vector<PosePair>& pairs) {
  if (pairs.empty()) return std::nullopt;
  std::vector<Mat3> turns;
  turns.reserve(pairs.size());
  for (const PosePair& pair : pairs) {
    turns.push_back(pair.found.rotation * pair.truth.rotation.Transposed());
  }
  // All pairs of a long recording would take hours: a few hundred represent them.
  constexpr std::size_t kMax = 300;
  const std::size_t step = turns.size() / kMax + 1;
  const auto median_angle = [&](const Mat3& from) {
    std::vector<double> angles;
    for (std::size_t i = 0; i < turns.size(); i += step) {
      angles.push_back(accuracy::AngleBetween(from, turns[i]));
    }
    return accuracy::Percentile(std::move(angles), 0.5);
  };
  std::size_t central = 0;
  double least = median_angle(turns[0]);
  for (std::size_t i = step; i < turns.size(); i += step) {
    const double angle = median_angle(turns[i]);
    if (angle >= least) continue;
    least = angle;
    central = i;
  }
  constexpr double kOutlier = 3.0;
  constexpr double kRounding = 1e-9;
  Quaternion sum =
      QuaternionOf(turns[central]);  // Reference for choosing between q and -q of the others.
  std::vector<const PosePair*> kept;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (accuracy::AngleBetween(turns[central], turns[i]) > kOutlier * least + kRounding) continue;
    if (i != central) sum = Weighted(sum, 1.0, QuaternionOf(turns[i]), 1.0);
    kept.push_back(&pairs[i]);
  }
  Transform<Marker, exports::Reference> marker_from_reference{RotationOf(sum), {}};
  Vec3 shift;
  for (const PosePair* pair : kept) {
    shift = shift + (pair->found.translation_m -
                     marker_from_reference.rotation * pair->truth.translation_m) *
                        (1.0 / static_cast<double>(kept.size()));
  }
  marker_from_reference.translation_m = shift;
  return marker_from_reference;
}

}  // namespace pleinair::app
