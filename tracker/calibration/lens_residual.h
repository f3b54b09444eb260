#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>

#include "base/camera_model.h"
#include "base/frames.h"

namespace pleinair::tracker {

/// fx fy cx cy, then the distortion.
constexpr int kLensNumbers = 12;
/// Rotation vector and translation of the board in the camera's frame.
constexpr int kPoseNumbers = 6;

using LensNumbers = std::array<double, kLensNumbers>;
using PoseNumbers = std::array<double, kPoseNumbers>;

LensNumbers NumbersOf(const CameraModel& camera);
void SetLensNumbers(const double* numbers, CameraModel* camera);
PoseNumbers NumbersOf(const Transform<Camera, Marker>& pose);
Transform<Camera, Marker> PoseOf(const PoseNumbers& numbers);

/// A pixel's derivatives, x before y, row-major.
struct PixelDerivatives {
  std::array<double, 2 * kLensNumbers> by_lens{};
  std::array<double, 2 * kPoseNumbers> by_pose{};
};

/// Pixel of a point of a board, and its derivatives where they are asked for. A point that comes to
/// lie behind the camera on a search's way is taken as lying close before it: far off, and finite.
Vec2 ProjectBoardPoint(const CameraModel& camera, const double* pose, Vec2 on_board_m,
                       PixelDerivatives* derivatives);

}  // namespace pleinair::tracker
