#include "compositor/picture/camera_look.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "compositor/picture/blur_estimate.h"
#include "compositor/picture/marker_in_image.h"
#include "compositor/picture/noise_model.h"

namespace pleinair::compositor {

double CameraLook::NoiseSigma(int channel, double light) const {
  return std::sqrt(noise_constant[channel] + noise_slope[channel] * std::max(0.0, light));
}

std::optional<CameraLook> MeasureCameraLook(ImageView<const std::uint8_t> rgb,
                                            const CameraModel& camera,
                                            const Transform<Camera, Marker>& camera_from_marker,
                                            const scene::MarkerReflectance& marker,
                                            const CameraResponse& response) {
  if (!(marker.size_m > 0.0) || !(marker.black_band_m > 0.0)) return std::nullopt;
  const MarkerInImage in_picture(rgb, camera, camera_from_marker, marker, response);
  const std::vector<double> blurs = EstimateEdgeBlur(in_picture);
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
