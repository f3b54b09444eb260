#include "tests/tracker/quads/quad_test_markers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace pleinair::tracker {

std::shared_ptr<const MarkerPattern> OutlinedMarker(unsigned seed) {
  constexpr int kQuiet = 4, kRim = 4, kEdge = 40, kModules = kEdge + 2 * kQuiet;
  constexpr int kBlock = 4;
  auto pattern = std::make_shared<MarkerPattern>();
  pattern->modules = kModules;
  pattern->edge_modules = kEdge;
  pattern->white.assign(kModules * kModules, 1);
  std::mt19937 random(seed);
  for (int y = kQuiet; y < kQuiet + kEdge; ++y) {
    for (int x = kQuiet; x < kQuiet + kEdge; ++x) pattern->white[y * kModules + x] = 0;
  }
  const int first = kQuiet + kRim, last = kQuiet + kEdge - kRim;
  for (int y = first; y < last; y += kBlock) {
    for (int x = first; x < last; x += kBlock) {
      if (random() % 2 == 0) continue;
      for (int j = 0; j < kBlock; ++j) {
        for (int i = 0; i < kBlock; ++i) pattern->white[(y + j) * kModules + x + i] = 1;
      }
    }
  }
  return pattern;
}

CameraModel Pinhole(int width, int height) {
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = 600.0;
  camera.cx = 0.5 * width;
  camera.cy = 0.5 * height;
  return camera;
}

RenderedMarker MarkerAt(const CameraModel& camera, unsigned seed, Vec2 centre_px, double side_px,
                        double tilt_deg, double axis_deg, double roll_deg) {
  RenderedMarker marker;
  marker.pattern = OutlinedMarker(seed);
  marker.camera_from_marker =
      PoseAtPixel(camera, centre_px, side_px, marker.size, FromDegrees(tilt_deg),
                  FromDegrees(axis_deg), FromDegrees(roll_deg));
  return marker;
}

double NearestError(const std::vector<Quad>& quads, const std::array<Vec2, 4>& truth) {
  double least = std::numeric_limits<double>::infinity();
  for (const Quad& quad : quads) {
    for (int turn = 0; turn < 4; ++turn) {
      double sum = 0.0;
      for (int i = 0; i < 4; ++i) {
        const Vec2 apart = quad.corners_px[(i + turn) % 4] - truth[i];
        sum += apart.x * apart.x + apart.y * apart.y;
      }
      least = std::min(least, std::sqrt(0.25 * sum));
    }
  }
  return least;
}

}  // namespace pleinair::tracker
