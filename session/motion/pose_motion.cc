#include "session/motion/pose_motion.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>

#include "session/motion/path_motion.h"
#include "session/path_gaps.h"

namespace pleinair::session {
namespace {

constexpr double kPerSecond = 1e9;
constexpr double kFastestTurn_rad_s = 10.0;

std::optional<PathMotion> MotionFrom(const std::vector<Observation>& path, std::size_t before) {
  const Observation &from = path[before], &to = path[before + 1];
  const double seconds = static_cast<double>(to.timestamp_ns - from.timestamp_ns) / kPerSecond;
  if (!(seconds > 0.0) || seconds > kMaxGap_s) return std::nullopt;
  const double turned_rad =
      RotationAngle(from.camera_from_marker.rotation, to.camera_from_marker.rotation);
  if (turned_rad > kFastestTurn_rad_s * seconds) return std::nullopt;
  return PathMotion(path, before);
}

}  // namespace

PoseMotion MotionAbout(const std::vector<Observation>& path, std::size_t index) {
  std::optional<PathMotion> before, after;
  if (index > 0) before = MotionFrom(path, index - 1);
  if (index + 1 < path.size()) after = MotionFrom(path, index);
  if (!before && !after) return {};
  if (!before) before = after;
  if (!after) after = before;
  struct Motions {
    PathMotion before, after;
  };
  const auto motions = std::make_shared<const Motions>(Motions{*before, *after});
  return [motions, pose = path[index].camera_from_marker,
          at_ns = path[index].timestamp_ns](double seconds) {
    if (seconds == 0.0) return pose;
    const std::int64_t time_ns = at_ns + std::llround(seconds * kPerSecond);
    return seconds < 0.0 ? motions->before.At(time_ns) : motions->after.At(time_ns);
  };
}

PoseMotion MovedTo(const PoseMotion& motion, const Transform<Camera, Marker>& camera_from_marker) {
  if (!motion) return {};
  // From the camera's coordinates at the frame to those at another time.
  return [motion, camera_from_marker, back = motion(0.0).Inverse()](double seconds) {
    return motion(seconds) * back * camera_from_marker;
  };
}

}  // namespace pleinair::session
