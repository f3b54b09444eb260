#include "tests/tracker/lens_rendering.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "accuracy/marker_pose.h"
#include "base/parallel_for.h"
#include "base/srgb.h"

namespace pleinair::tracker {
namespace {

constexpr int kRays = 256, kTimes = 16;

/// The print at one time: its plane as the camera sees it.
struct Plane {
  Transform<Marker, Camera> marker_from_camera;

  /// Where a ray meets it, in its own coordinates, metres.
  Vec2 Hit(Vec3 from, Vec3 direction) const {
    const Vec3 origin = (marker_from_camera * Point<Camera>{from}).xyz;
    const Vec3 along = marker_from_camera.rotation * direction;
    const double t = -origin.z / along.z;
    return {origin.x + t * along.x, origin.y + t * along.y};
  }
};

double LightAt(const LensPicture& picture, Vec2 at_m) {
  const MarkerPattern& pattern = *picture.pattern;
  const double half = picture.size.value() / 2, extent = pattern.Extent();
  const double x = at_m.x / half, y = at_m.y / half;
  if (!(std::fabs(x) < extent && std::fabs(y) < extent)) return picture.background;
  const double modules = pattern.modules / (2.0 * extent);
  const int column = std::min(pattern.modules - 1, static_cast<int>((x + extent) * modules));
  const int row = std::min(pattern.modules - 1, static_cast<int>((extent - y) * modules));
  return pattern.white[static_cast<std::size_t>(row) * pattern.modules + column] != 0
             ? picture.white
             : picture.black;
}

/// One of a sequence that fills the square evenly (Roberts 2018), from its own start.
double Even(int i, double step, double start) { return std::fmod(start + i * step, 1.0); }

/// Where a ray passes the pixel and the stop.
struct Ray {
  Vec2 in_pixel, on_stop;
};

/// Sets of rays: pixels take them by turns, so that what they miss is noise and no pattern.
std::vector<std::vector<Ray>> RaySets(const LensPicture& picture) {
  constexpr std::size_t kSets = 61;
  std::mt19937 random(picture.seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal(0.0, picture.own_blur_px);
  std::vector<std::vector<Ray>> sets(kSets, std::vector<Ray>(kRays));
  for (std::vector<Ray>& set : sets) {
    const double start[4] = {uniform(random), uniform(random), uniform(random), uniform(random)};
    for (int i = 0; i < kRays; ++i) {
      Ray& ray = set[static_cast<std::size_t>(i)];
      ray.in_pixel = {Even(i, 0.7548776662466927, start[0]) - 0.5,
                      Even(i, 0.5698402909980532, start[1]) - 0.5};
      if (picture.own_blur_px > 0.0) {
        ray.in_pixel = ray.in_pixel + Vec2{normal(random), normal(random)};
      }
      const double r = 0.5 * picture.aperture_m * std::sqrt(Even(i, 0.6180339887498949, start[2]));
      const double angle = 2 * std::numbers::pi * Even(i, 0.8191725133961645, start[3]);
      ray.on_stop = {r * std::cos(angle), r * std::sin(angle)};
    }
  }
  return sets;
}

}  // namespace

GreyImage RenderThroughLens(const CameraModel& camera, const LensPicture& picture) {
  std::vector<Plane> planes;
  planes.reserve(kTimes);
  for (int i = 0; i < kTimes; ++i) {
    planes.push_back({picture.camera_from_marker((i + 0.5) / kTimes - 0.5).Inverse()});
  }
  const auto sets = RaySets(picture);
  const auto pose = picture.camera_from_marker(0.0);
  accuracy::PixelBox box = accuracy::BoxOf(camera, pose, picture.size, picture.pattern->Extent());
  // As far as anything is blurred.
  const double circle_px = camera.fx * picture.aperture_m *
                           std::fabs(picture.focus_dioptres - 1.0 / pose.translation_m.z);
  const double around_px = 12.0 + circle_px + 4.0 * picture.own_blur_px;
  box = {box.left - around_px, box.right + around_px, box.top - around_px, box.bottom + around_px};
  GreyImage image(camera.width, camera.height);
  ParallelFor(static_cast<std::size_t>(camera.height), 0, [&](std::size_t row) {
    const int y = static_cast<int>(row);
    std::mt19937 random(picture.seed * 7919U + static_cast<std::uint32_t>(row));
    std::normal_distribution<double> normal(0.0, std::max(picture.noise_codes, 1e-9));
    for (int x = 0; x < camera.width; ++x) {
      double light = picture.background;
      if (box.Contains(x, y)) {
        const Vec2 centre = UndistortPixel(camera, {1.0 * x, 1.0 * y});
        const Vec2 right = UndistortPixel(camera, {x + 1.0, 1.0 * y}) - centre;
        const Vec2 down = UndistortPixel(camera, {1.0 * x, y + 1.0}) - centre;
        double sum = 0.0;
        const std::vector<Ray>& rays = sets[random() % sets.size()];
        for (int i = 0; i < kRays; ++i) {
          const Ray& by = rays[static_cast<std::size_t>(i)];
          const Vec2 ray = centre + right * by.in_pixel.x + down * by.in_pixel.y;
          // Through the point in the plane of focus that the pinhole sees.
          const Vec3 direction{ray.x - by.on_stop.x * picture.focus_dioptres,
                               ray.y - by.on_stop.y * picture.focus_dioptres, 1.0};
          const Plane& plane = planes[static_cast<std::size_t>(i % kTimes)];
          sum += LightAt(picture, plane.Hit({by.on_stop.x, by.on_stop.y, 0.0}, direction));
        }
        light = sum / kRays;
      }
      double code = 255.0 * SrgbFromLinear(light);
      if (picture.noise_codes > 0.0) code += normal(random);
      image(x, y) = static_cast<std::uint8_t>(std::clamp(code + 0.5, 0.0, 255.0));
    }
  });
  return image;
}

}  // namespace pleinair::tracker
