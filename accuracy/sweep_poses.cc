#include "accuracy/sweep_poses.h"

#include <algorithm>
#include <cmath>

#include "accuracy/marker_pose.h"

namespace pleinair::accuracy {
namespace {

/// Whether the square, with a margin of 13 % of its edge, is inside the image.
bool IsInImage(const CameraModel& camera, const Transform<Camera, Marker>& pose) {
  constexpr double kMargin = 0.13, kRim_px = 3.0;
  const auto corners = SquareCorners(camera, pose, kMarkerEdge * (1.0 + 2.0 * kMargin));
  return std::all_of(corners.begin(), corners.end(), [&](Vec2 at) {
    return at.x > kRim_px && at.y > kRim_px && at.x < camera.width - 1 - kRim_px &&
           at.y < camera.height - 1 - kRim_px;
  });
}

}  // namespace

MarkerSpec PlaceMarker(const CameraModel& camera, const PlaceWanted& wanted, RandomStream* random) {
  // Anywhere first; then near the centre, where alone a large marker may fit.
  constexpr int kTries = 200, kAnywhere = 100;
  MarkerSpec marker{.side_px = wanted.side_px, .tilt_deg = wanted.tilt_deg};
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const double rim = attempt < kAnywhere ? 0.18 : 0.4;
    Vec2 centre;
    if (wanted.centre_px) {
      centre = *wanted.centre_px;
    } else {
      centre.x = camera.width * random->Uniform(rim, 1.0 - rim);
      centre.y = camera.height * random->Uniform(rim, 1.0 - rim);
    }
    const double roll = wanted.roll ? *wanted.roll : random->Uniform(-M_PI, M_PI);
    const double axis = wanted.tilt_axis ? *wanted.tilt_axis : random->Uniform(-M_PI, M_PI);
    marker.camera_from_marker =
        PoseAtPixel(camera, centre, wanted.side_px, kMarkerEdge, FromDegrees(wanted.tilt_deg),
                    Radians(axis), Radians(roll));
    if (wanted.centre_px || IsInImage(camera, marker.camera_from_marker)) break;
  }
  marker.number = wanted.number ? *wanted.number : random->Below(kNumbers);
  return marker;
}

}  // namespace pleinair::accuracy
