#include "app/output/observed_trajectory.h"

#include <fmt/format.h>

namespace pleinair::app {

exports::TrajectoryPose ObservedPose(const session::Observation& at) {
  // The marker is the frame of reference of the trajectory.
  const Transform<exports::Reference, Marker> reference_from_marker;
  return {at.timestamp_ns, reference_from_marker * at.camera_from_marker.Inverse(),
          fmt::format("frames/{:04}.png", at.frame_index)};
}

exports::CameraTrajectory ObservedTrajectory(
    const std::vector<session::Observation>& observations) {
  exports::CameraTrajectory path;
  path.poses.reserve(observations.size());
  for (const session::Observation& at : observations) path.poses.push_back(ObservedPose(at));
  return path;
}

}  // namespace pleinair::app
