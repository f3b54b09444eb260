#pragma once

#include "base/camera_model.h"
#include "base/image.h"

namespace pleinair::compositor {

/// The pinhole camera that the virtual picture is drawn with before the lens bends it. Shares the
/// real camera's centre and axes; covers everything that the lens sees.
struct RenderCamera {
  int width = 0;  ///< Render pixels.
  int height = 0;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< Render pixels, integer = pixel centre.
};

/// A pinhole camera that covers the picture of `camera`, with `supersampling` render pixels a
/// camera pixel at the centre. A lens that sees more than about 75° off its axis is covered up to
/// there.
RenderCamera FitRenderCamera(const CameraModel& camera, double supersampling);

/// For each camera pixel, where in the render picture its light comes from: two channels, x and y
/// in render texels with texel centres at .5 (OpenGL's origin).
Image<float> RenderPositions(const CameraModel& camera, const RenderCamera& render);

/// For each render pixel, where in the camera's picture its light comes to: as RenderPositions()
/// the other way round.
Image<float> CameraPositions(const CameraModel& camera, const RenderCamera& render);

}  // namespace pleinair::compositor
