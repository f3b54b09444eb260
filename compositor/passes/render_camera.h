#pragma once

#include "base/camera_model.h"
#include "base/image.h"

namespace pleinair::compositor {

/// Pinhole camera of the virtual image, before the lens distorts it. It shares the real camera's
/// centre and axes, and covers everything that the lens sees.
struct RenderCamera {
  int width = 0;  ///< Render pixels.
  int height = 0;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< Render pixels, integer = pixel centre.
};

/// Fits a pinhole camera that covers the image of `camera`, with `supersampling` render pixels per
/// camera pixel at the centre. A lens that sees more than about 75° off its axis is covered up to
/// that angle.
RenderCamera FitRenderCamera(const CameraModel& camera, double supersampling);

/// The same view with one pixel for `step` by `step`. At the right and bottom it may see more.
RenderCamera CoarserBy(int step, const RenderCamera& camera);

/// Maps each camera pixel to its position in the render image. Two channels: x and y in render
/// texels, with texel centres at .5 (OpenGL's origin).
Image<float> RenderPositions(const CameraModel& camera, const RenderCamera& render);

/// Maps each render pixel to its position in the camera image; the inverse of RenderPositions().
Image<float> CameraPositions(const CameraModel& camera, const RenderCamera& render);

}  // namespace pleinair::compositor
