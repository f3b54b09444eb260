#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/camera_model.h"
#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// A marker of an anchor: the reference marker or another one that does not move against it.
struct AnchorMarker {
  double size_m = 0.0;
  /// Pose in the coordinates of the reference marker; nothing: not known yet.
  std::optional<Transform<Marker, Marker>> reference_from_marker;
};

/// One marker of an anchor in one frame.
struct AnchorSighting {
  std::size_t marker = 0;  ///< Index in the list of the anchor's markers.
  std::array<Vec2, 4> corners_px;
  double deviation_px = 0.1;  ///< Standard deviation of each corner coordinate.
  Transform<Camera, Marker> camera_from_marker;
};

/// The markers of an anchor that one frame shows.
using AnchorFrame = std::vector<AnchorSighting>;

/// Places the markers without a pose by bundle adjustment of the frames that show two or more
/// markers (Triggs et al. 2000, "Bundle adjustment"). It minimises the distances of all corners
/// from their projections, with Huber's loss per corner (Huber 1964). The unknowns are the poses of
/// the frames and of these markers. Takes at most 300 frames. A marker that no frame shows beside a
/// placed one stays without a pose.
void PlaceAnchorMarkers(const CameraModel& camera, const std::vector<AnchorFrame>& frames,
                        std::vector<AnchorMarker>* markers);

/// The pose of the camera against the reference marker.
struct AnchoredPose {
  Transform<Camera, Marker> camera_from_reference;
  double reprojection_rms_px = 0.0;
};

/// Fits the pose of a frame to the corners of all placed markers that it shows, with the same loss.
/// A corner that is far off pulls no more than one that is 2.5 standard deviations off. A marker
/// that was moved still turns the pose about the others. Nothing if the frame shows none.
std::optional<AnchoredPose> FitAnchoredPose(const CameraModel& camera,
                                            const std::vector<AnchorMarker>& markers,
                                            const AnchorFrame& frame);

}  // namespace pleinair::tracker
