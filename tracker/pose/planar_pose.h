#pragma once

#include <array>
#include <optional>

#include "base/camera_model.h"
#include "base/units.h"
#include "tracker/observation.h"

namespace pleinair::tracker {

/// Covariance of four corners: x before y, corner after corner; px², row-major.
using CornerCovariance = std::array<double, 64>;

/// The same uncertainty, independent, for all coordinates.
CornerCovariance IsotropicCornerCovariance(double sigma_px);

/// Pose of a square of edge `size` from its corners (top-left, then clockwise as the marker is
/// read; pixels, integer = centre), which may lie anywhere the lens can see.
///
/// Both solutions of the planar problem start from IPPE (Collins & Bartoli 2014, "Infinitesimal
/// plane-based pose estimation") on undistorted rays and are refined in distorted pixels, weighted
/// by the corners' covariance. The one that fits better comes first; no alternative is given when
/// both end in the same pose. Where the corners do not tell the two apart (χ² differs by less than
/// 9, odds of 90 to 1), `likely_rotation`, such as that of the frame before, decides; without it,
/// the covariance counts with the other at its odds. Nothing is returned when the corners admit no
/// pose in front of the camera.
std::optional<PoseEstimate> EstimatePlanarPose(const CameraModel& camera,
                                               const std::array<Vec2, 4>& corners_px,
                                               const CornerCovariance& corner_covariance_px2,
                                               Metres size, const Mat3* likely_rotation = nullptr);

}  // namespace pleinair::tracker
