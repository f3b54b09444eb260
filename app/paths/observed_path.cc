#include "app/paths/observed_path.h"

#include <fmt/format.h>

namespace pleinair::app {

CameraPath ObservedPath(const std::vector<Observation>& observations) {
  // The marker is what the path is told in.
  const Transform<Reference, Marker> reference_from_marker;
  CameraPath path;
  path.poses.reserve(observations.size());
  for (const Observation& at : observations) {
    path.poses.push_back({at.timestamp_ns, reference_from_marker * at.camera_from_marker.Inverse(),
                          fmt::format("frames/{:04}.png", at.frame_index)});
  }
  return path;
}

}  // namespace pleinair::app
