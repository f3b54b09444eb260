#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>

#include "base/camera_model.h"
#include "base/frames.h"
#include "tracker/pose/pose_numbers.h"

namespace pleinair::tracker {

/// Lens parameters: fx fy cx cy, then the distortion.
constexpr int kLensNumbers = 12;

using LensNumbers = std::array<double, kLensNumbers>;

LensNumbers NumbersOf(const CameraModel& camera);
void SetLensNumbers(const double* numbers, CameraModel* camera);

/// Derivatives of a pixel, x before y, row-major.
struct PixelDerivatives {
  std::array<double, 2 * kLensNumbers> by_lens{};
  std::array<double, 2 * kPoseNumbers> by_pose{};
};

/// Projects a point of a board to a pixel; also computes derivatives if requested. A point that
/// moves behind the camera during the search is treated as if close in front of it: far off, but
/// finite.
Vec2 ProjectBoardPoint(const CameraModel& camera, const double* pose, Vec2 on_board_m,
                       PixelDerivatives* derivatives);

}  // namespace pleinair::tracker
