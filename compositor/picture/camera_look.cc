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

/// Diameters of the circles of confusion at the middles of the marker's sides, pixels.
std::array<double, 4> CirclesOfSides(const ThinLens& lens, const CameraModel& camera,
                                     const Transform<Camera, Marker>& camera_from_marker,
                                     double size_m) {
  const double half = size_m / 2;
  const std::array<Vec3, 4> middles{
      {{0.0, half, 0.0}, {-half, 0.0, 0.0}, {0.0, -half, 0.0}, {half, 0.0, 0.0}}};
  std::array<double, 4> circles{};
  for (std::size_t side = 0; side < circles.size(); ++side) {
    const double depth_m = (camera_from_marker * Point<Marker>{middles[side]}).xyz.z;
    if (depth_m > 0.0) circles[side] = CircleOfConfusion_px(lens, camera.fx, depth_m);
  }
  return circles;
}

}  // namespace

std::optional<CameraLook> MeasureCameraLook(ImageView<const std::uint8_t> rgb,
                                            const CameraModel& camera,
                                            const Transform<Camera, Marker>& camera_from_marker,
                                            const scene::MarkerReflectance& marker,
                                            const CameraResponse& response,
                                            const std::optional<ThinLens>& lens) {
  if (!(marker.size_m > 0.0) || !(marker.black_band_m > 0.0)) return std::nullopt;
  const MarkerInImage in_picture(rgb, camera, camera_from_marker, marker, response);
  const std::vector<double> blurs = EstimateEdgeBlur(
      in_picture, lens ? CirclesOfSides(*lens, camera, camera_from_marker, marker.size_m)
                       : std::array<double, 4>{});
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
