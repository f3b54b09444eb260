#include "compositor/picture/camera_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "compositor/picture/blur_estimate.h"
#include "compositor/picture/marker_in_image.h"
#include "compositor/picture/noise_model.h"

namespace pleinair::compositor {

double CameraLook::NoiseSigma(int channel, double light) const {
  return std::sqrt(noise_constant[channel] + noise_slope[channel] * std::max(0.0, light));
}

namespace {

/// Middles of the sides of a square of size 2: top, left, bottom, right.
constexpr std::array<Vec2, 4> kMiddles{{{0.0, 1.0}, {-1.0, 0.0}, {0.0, -1.0}, {1.0, 0.0}}};

/// Diameters of the circles of confusion at the middles of the marker's sides, pixels.
std::array<double, 4> CirclesOfSides(const ThinLens& lens, const CameraModel& camera,
                                     const Transform<Camera, Marker>& camera_from_marker,
                                     double size_m) {
  std::array<double, 4> circles{};
  for (std::size_t side = 0; side < circles.size(); ++side) {
    const Vec2 middle = kMiddles[side] * (size_m / 2);
    const double depth_m = (camera_from_marker * Point<Marker>{{middle.x, middle.y, 0.0}}).xyz.z;
    if (depth_m > 0.0) circles[side] = CircleOfConfusion_px(lens, camera.fx, depth_m);
  }
  return circles;
}

// Shorter streaks are not drawn on objects either (LensPass::kMinStreak_px), and add 0.01 px.
constexpr double kMinStreak_px = 0.3;

/// How far the middles of the marker's sides move across these, pixels.
std::array<double, 4> StreaksOfSides(const CameraMotion& motion, const CameraModel& camera,
                                     double size_m) {
  const Transform<Camera, Marker> first = motion(-0.5), at = motion(0.0), last = motion(0.5);
  std::array<double, 4> streaks{};
  for (std::size_t side = 0; side < streaks.size(); ++side) {
    const Vec2 middle = kMiddles[side] * (size_m / 2);
    const Vec2 along{0.1 * middle.y, -0.1 * middle.x};
    const auto pixel = [&](const Transform<Camera, Marker>& pose, Vec2 on_marker) {
      Point<Camera> p = pose * Point<Marker>{{on_marker.x, on_marker.y, 0.0}};
      p.xyz.z = std::max(p.xyz.z, 1e-3);
      return ProjectToPixel(camera, p);
    };
    const Vec2 edge = pixel(at, middle + along) - pixel(at, middle - along);
    const Vec2 moved = pixel(last, middle) - pixel(first, middle);
    const double length = Norm(edge);
    if (!(length > 0.0)) continue;
    const double streak_px = std::fabs(edge.x * moved.y - edge.y * moved.x) / length;
    if (streak_px >= kMinStreak_px) streaks[side] = streak_px;
  }
  return streaks;
}

}  // namespace

std::optional<CameraLook> MeasureCameraLook(ImageView<const std::uint8_t> rgb,
                                            const CameraModel& camera,
                                            const Transform<Camera, Marker>& camera_from_marker,
                                            const scene::MarkerReflectance& marker,
                                            const CameraResponse& response,
                                            const std::optional<ThinLens>& lens,
                                            const CameraMotion& motion) {
  if (!(marker.size_m > 0.0) || !(marker.black_band_m > 0.0)) return std::nullopt;
  const MarkerInImage in_picture(rgb, camera, camera_from_marker, marker, response);
  KnownSpread known;
  if (lens) known.circles_px = CirclesOfSides(*lens, camera, camera_from_marker, marker.size_m);
  if (motion) known.streaks_px = StreaksOfSides(motion, camera, marker.size_m);
  const std::vector<double> blurs = EstimateEdgeBlur(in_picture, known);
  if (blurs.size() < 2) return std::nullopt;
  CameraLook look;
  double sum = 0.0;
  for (const double blur : blurs) sum += blur * blur;
  // Motion blurs some sides more than others. Their mean square is the best single value.
  look.blur_px = std::sqrt(sum / static_cast<double>(blurs.size()));
  if (!MeasureNoise(in_picture, look.blur_px, &look)) return std::nullopt;
  return look;
}

}  // namespace pleinair::compositor
