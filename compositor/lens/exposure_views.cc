#include "compositor/lens/exposure_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "compositor/lens/lens_view.h"
#include "compositor/lens/stop_places.h"
#include "compositor/passes/glm_vectors.h"
#include "compositor/passes/scene_view.h"

namespace pleinair::compositor {
namespace {

/// Times of the exposure at which points are followed.
constexpr std::array<double, 4> kFollowed{-0.5, -0.25, 0.25, 0.5};
// Within an exposure surfaces may come nearer than the frame's near plane, and go beyond its far
// one.
constexpr double kNearer = 0.9, kFarther = 1.1;

/// Shares −½…½ of the exposure, in the order of the digit-reversed numbers.
std::vector<double> TimesOfExposure(int count) {
  std::vector<double> reversed(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < reversed.size(); ++i) {
    double digit = 0.5;
    for (std::size_t rest = i; rest > 0; rest /= 2, digit *= 0.5) {
      if (rest % 2 == 1) reversed[i] += digit;
    }
  }
  std::vector<std::size_t> order(reversed.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return reversed[a] < reversed[b]; });
  std::vector<double> shares(reversed.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    shares[order[rank]] = (static_cast<double>(rank) + 0.5) / count - 0.5;
  }
  return shares;
}

}  // namespace

double LongestStreak_px(const RenderCamera& camera, const CameraMotion& motion,
                        std::span<const PixelRect> within, const DioptreRange& range) {
  const Transform<Marker, Camera> back = motion(0.0).Inverse();
  std::array<Transform<Camera, Camera>, kFollowed.size()> moved;
  std::transform(kFollowed.begin(), kFollowed.end(), moved.begin(),
                 [&](double share) { return motion(share) * back; });
  double longest_px = 0.0;
  const auto follow = [&](double x, double y, double dioptres) {
    const Point<Camera> here{{(x - camera.cx) / camera.fx / dioptres,
                              (y - camera.cy) / camera.fy / dioptres, 1.0 / dioptres}};
    const auto pixel = [&](const Point<Camera>& at) {
      const double z = std::max(at.xyz.z, 0.1 * here.xyz.z);  // Behind the camera: not drawn.
      return Vec2{camera.fx * at.xyz.x / z, camera.fy * at.xyz.y / z};
    };
    double streak_px = 0.0;
    Vec2 last = pixel(moved.front() * here);
    for (std::size_t i = 1; i < moved.size(); ++i) {
      const Vec2 next = pixel(moved[i] * here);
      streak_px += Norm(next - last);
      last = next;
    }
    longest_px = std::max(longest_px, streak_px);
  };
  for (const PixelRect& rect : within) {
    for (const int x : {rect.x, rect.x + rect.width}) {
      for (const int y : {rect.y, rect.y + rect.height}) {
        for (const float dioptres : {range.min, range.max}) follow(x, y, dioptres);
      }
    }
  }
  return longest_px;
}

AveragedViews ExposureViews(const LensFrame& lens_frame, const RenderCamera& camera, int count) {
  AveragedViews views{lens_frame.view, {}};
  views.frames.reserve(static_cast<std::size_t>(count));
  if (lens_frame.motion) {
    views.planes.near_m *= kNearer;
    views.planes.far_m *= kFarther;
  }
  const std::vector<double> times = TimesOfExposure(count);
  const std::vector<Vec2> places = StopPlaces(lens_frame.lens.stop, count);
  for (std::size_t i = 0; i < times.size(); ++i) {
    shadows::View view = views.planes;
    FrameUniforms frame = lens_frame.frame;
    if (lens_frame.motion) {
      const Transform<Camera, Marker> pose = lens_frame.motion(times[i]);
      view.camera_from_marker = CameraFromMarkerMatrix(pose);
      frame.clip_from_marker = glm::mat4(view.ClipFromMarker());
      frame.eye_m = ToGlm(pose.Inverse().translation_m);
      frame.ray = RaysThroughPixels(camera, view);
    }
    if (lens_frame.lens.aperture_m > 0.0) {
      frame = SeenThroughPlace(frame, view, lens_frame.lens,
                               places[i] * (lens_frame.lens.aperture_m / 2));
    }
    views.frames.push_back(frame);
  }
  return views;
}

}  // namespace pleinair::compositor
