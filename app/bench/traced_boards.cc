#include "app/bench/traced_boards.h"

#include <cstddef>
#include <functional>
#include <vector>

#include "app/bench/traced_rays.h"
#include "base/parallel_for.h"

namespace pleinair::app {
namespace {

/// Light of the nearest board that a ray meets; black behind them all.
float LightSeen(const DefocusScene& scene, double x, double y, const RayPlaces& ray) {
  for (const BenchBoard& board : scene.boards) {
    if (board.Covers(x + ray.x - board.circle_px * ray.stop_x,
                     y + ray.y - board.circle_px * ray.stop_y)) {
      return board.light;
    }
  }
  return 0.0F;
}

/// Means over the rays of each pixel. `sum_of`: the light along them.
Image<float> MeansOfRays(
    int width, int height,
    const std::function<double(int x, int y, const std::vector<RayPlaces>& rays)>& sum_of) {
  const std::vector<RayPlaces> rays = TracedRays();
  Image<float> light(width, height);
  ParallelFor(static_cast<std::size_t>(height), 0, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      light(x, y) = static_cast<float>(sum_of(x, y, rays) / static_cast<double>(rays.size()));
    }
  });
  return light;
}

/// Light of the nearest board that a ray of a moving camera meets. Boards face the frame's camera.
float LightSeenMoving(const DefocusScene& scene, const CameraModel& camera, double x, double y,
                      const RayPlaces& ray, const Transform<Camera, Camera>& frame_from_now) {
  // From a place on the stop through the point in focus of the pixel's place.
  const Vec3 ahead{(x + ray.x - 0.5 - camera.cx) / camera.fx,
                   (y + ray.y - 0.5 - camera.cy) / camera.fy, 1.0};
  const Vec3 start{ray.stop_x * scene.lens.aperture_m, ray.stop_y * scene.lens.aperture_m, 0.0};
  const Vec3 along = ahead - start * scene.lens.focus_dioptres;
  const Vec3 from = (frame_from_now * Point<Camera>{start}).xyz;
  const Vec3 way = (frame_from_now * Direction<Camera>{along}).xyz;
  for (const BenchBoard& board : scene.boards) {
    const double length = (board.distance_m - from.z) / way.z;
    const double to_px = camera.fx / board.distance_m;
    if (board.Covers((from.x + length * way.x) * to_px + camera.cx + 0.5,
                     (from.y + length * way.y) * to_px + camera.cy + 0.5)) {
      return board.light;
    }
  }
  return 0.0F;
}

}  // namespace

Image<float> TraceBoards(const DefocusScene& scene, int width, int height) {
  return MeansOfRays(width, height, [&](int x, int y, const std::vector<RayPlaces>& rays) {
    double sum = 0.0;
    for (const RayPlaces& ray : rays) sum += LightSeen(scene, x, y, ray);
    return sum;
  });
}

Image<float> TraceMovingCamera(const DefocusScene& scene, const CameraModel& camera) {
  const std::vector<RayPlaces> all = TracedRays();
  std::vector<Transform<Camera, Camera>> poses(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    poses[i] = scene.camera_from_marker * scene.motion(all[i].time).Inverse();
  }
  return MeansOfRays(camera.width, camera.height,
                     [&](int x, int y, const std::vector<RayPlaces>& rays) {
                       double sum = 0.0;
                       for (std::size_t i = 0; i < rays.size(); ++i) {
                         sum += LightSeenMoving(scene, camera, x, y, rays[i], poses[i]);
                       }
                       return sum;
                     });
}

}  // namespace pleinair::app
