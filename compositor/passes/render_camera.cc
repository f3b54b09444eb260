#include "compositor/passes/render_camera.h"

#include <algorithm>
#include <cmath>

#include "base/pixel_origin.h"

namespace pleinair::compositor {
namespace {

constexpr double kWidestTangent = 3.732;  // tan 75°.
constexpr int kMaxSide = 8192;

Vec2 ClampedRay(const CameraModel& camera, Vec2 pixel) {
  const Vec2 ray = UndistortPixel(camera, pixel);
  return {std::clamp(ray.x, -kWidestTangent, kWidestTangent),
          std::clamp(ray.y, -kWidestTangent, kWidestTangent)};
}

}  // namespace

RenderCamera FitRenderCamera(const CameraModel& camera, double supersampling) {
  RenderCamera render;
  render.fx = camera.fx * supersampling;
  render.fy = camera.fy * supersampling;
  if (!camera.HasDistortion()) {
    render.width = static_cast<int>(std::lround(camera.width * supersampling));
    render.height = static_cast<int>(std::lround(camera.height * supersampling));
    render.cx = (camera.cx + 0.5) * supersampling - 0.5;
    render.cy = (camera.cy + 0.5) * supersampling - 0.5;
    return render;
  }
  double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
  const auto include = [&](double u, double v) {
    const Vec2 ray = ClampedRay(camera, {u, v});
    left = std::min(left, ray.x);
    right = std::max(right, ray.x);
    top = std::min(top, ray.y);
    bottom = std::max(bottom, ray.y);
  };
  for (int x = -1; x <= camera.width; ++x) {
    include(x, -1);
    include(x, camera.height);
  }
  for (int y = -1; y <= camera.height; ++y) {
    include(-1, y);
    include(camera.width, y);
  }
  render.width =
      std::clamp(static_cast<int>(std::ceil((right - left) * render.fx)) + 2, 1, kMaxSide);
  render.height =
      std::clamp(static_cast<int>(std::ceil((bottom - top) * render.fy)) + 2, 1, kMaxSide);
  render.cx = -left * render.fx + 0.5;
  render.cy = -top * render.fy + 0.5;
  return render;
}

RenderCamera CoarserBy(int step, const RenderCamera& camera) {
  RenderCamera coarse = camera;
  coarse.width = (camera.width + step - 1) / step;
  coarse.height = (camera.height + step - 1) / step;
  coarse.fx /= step;
  coarse.fy /= step;
  coarse.cx = (camera.cx + 0.5) / step - 0.5;
  coarse.cy = (camera.cy + 0.5) / step - 0.5;
  return coarse;
}

Image<float> RenderPositions(const CameraModel& camera, const RenderCamera& render) {
  Image<float> positions(camera.width, camera.height, 2);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Vec2 ray = ClampedRay(camera, {static_cast<double>(x), static_cast<double>(y)});
      const Vec2 texel =
          CornerOriginFromPixel({render.fx * ray.x + render.cx, render.fy * ray.y + render.cy});
      positions(x, y, 0) = static_cast<float>(texel.x);
      positions(x, y, 1) = static_cast<float>(texel.y);
    }
  }
  return positions;
}

Image<float> CameraPositions(const CameraModel& camera, const RenderCamera& render) {
  Image<float> positions(render.width, render.height, 2);
  for (int y = 0; y < render.height; ++y) {
    for (int x = 0; x < render.width; ++x) {
      const Point<Camera> ahead{{(x - render.cx) / render.fx, (y - render.cy) / render.fy, 1.0}};
      const Vec2 texel = CornerOriginFromPixel(ProjectToPixel(camera, ahead));
      positions(x, y, 0) = static_cast<float>(texel.x);
      positions(x, y, 1) = static_cast<float>(texel.y);
    }
  }
  return positions;
}

}  // namespace pleinair::compositor
