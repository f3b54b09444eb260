#pragma once

#include <array>
#include <optional>

#include "base/camera_model.h"
#include "base/units.h"
#include "tracker/observation.h"

namespace pleinair::tracker {

/// Covariance of four corners: x before y, corner after corner; px², row-major.
using CornerCovariance = std::array<double, 64>;

/// Equal, independent variances for all coordinates.
CornerCovariance IsotropicCornerCovariance(double sigma_px);

/// Pose of a square of edge `size` from its corners (clockwise from top-left on the upright marker;
/// pixels, integer = centre). Corners may lie anywhere in the lens's field of view, also outside
/// the image.
///
/// Both solutions of the planar problem start from IPPE (Collins & Bartoli 2014, "Infinitesimal
/// plane-based pose estimation") on undistorted rays. They are refined in distorted pixels,
/// weighted by the corners' covariance. The better fit comes first; there is no alternative if both
/// converge to the same pose. The corners may not separate the two: χ² differs by less than 9, odds
/// of 90 to 1. Then `likely_rotation` decides, for example that of the previous frame. Without it,
/// the covariance includes the other solution with its probability. Returns nullopt if the corners
/// admit no pose in front of the camera.
std::optional<PoseEstimate> EstimatePlanarPose(const CameraModel& camera,
                                               const std::array<Vec2, 4>& corners_px,
                                               const CornerCovariance& corner_covariance_px2,
                                               Metres size, const Mat3* likely_rotation = nullptr);

}  // namespace pleinair::tracker
