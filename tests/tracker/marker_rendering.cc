#include "tests/tracker/marker_rendering.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/srgb.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

constexpr int kSamples = 12;

/// Light of the marker at its intersection with a ray (undistorted, z = 1); negative outside it.
class MarkerUnderRays {
 public:
  explicit MarkerUnderRays(const RenderedMarker& marker)
      : marker_(marker),
        marker_from_rays_(accuracy::PlaneFromRays(marker.camera_from_marker, marker.size)) {}

  double operator()(Vec2 ray) const {
    const Vec2 at = Apply(marker_from_rays_, ray);
    const MarkerPattern& pattern = *marker_.pattern;
    const double extent = pattern.Extent();
    if (!(std::fabs(at.x) < extent && std::fabs(at.y) < extent)) return -1.0;
    if (marker_.cover) {
      const double cover = marker_.cover(at);
      if (cover >= 0.0) return cover;
    }
    const double modules_per_unit = pattern.modules / (2.0 * extent);
    const int column =
        std::min(pattern.modules - 1, static_cast<int>((at.x + extent) * modules_per_unit));
    const int row =
        std::min(pattern.modules - 1, static_cast<int>((extent - at.y) * modules_per_unit));
    return pattern.white[row * pattern.modules + column] != 0 ? marker_.white : marker_.black;
  }

 private:
  const RenderedMarker& marker_;
  const Mat3 marker_from_rays_;
};

Image<double> Blurred(const Image<double>& sharp, double sigma_px) {
  const int radius = static_cast<int>(std::ceil(4.0 * sigma_px));
  std::vector<double> kernel;
  double sum = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    kernel.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += kernel.back();
  }
  const auto pass = [&](const Image<double>& from, int dx, int dy) {
    Image<double> to(from.width(), from.height());
    for (int y = 0; y < from.height(); ++y) {
      for (int x = 0; x < from.width(); ++x) {
        double value = 0.0;
        for (int i = -radius; i <= radius; ++i) {
          value += kernel[i + radius] / sum *
                   from(std::clamp(x + i * dx, 0, from.width() - 1),
                        std::clamp(y + i * dy, 0, from.height() - 1));
        }
        to(x, y) = value;
      }
    }
    return to;
  };
  return pass(pass(sharp, 1, 0), 0, 1);
}

}  // namespace

GreyImage RenderMarkers(const CameraModel& camera, const std::vector<RenderedMarker>& markers,
                        const RenderingOptions& options) {
  std::vector<MarkerUnderRays> prints(markers.begin(), markers.end());
  std::vector<accuracy::PixelBox> boxes;
  for (const RenderedMarker& marker : markers) {
    boxes.push_back(
        accuracy::BoxOf(camera, marker.camera_from_marker, marker.size, marker.pattern->Extent()));
  }
  std::vector<const MarkerUnderRays*> near;
  Image<double> light(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      near.clear();
      for (std::size_t i = 0; i < prints.size(); ++i) {
        if (boxes[i].Contains(x, y)) near.push_back(&prints[i]);
      }
      if (near.empty() && !options.light && !options.glare) {
        light(x, y) = options.background;
        continue;
      }
      const Vec2 ray = UndistortPixel(camera, {1.0 * x, 1.0 * y});
      const Vec2 d_x =
          UndistortPixel(camera, {x + 0.5, 1.0 * y}) - UndistortPixel(camera, {x - 0.5, 1.0 * y});
      const Vec2 d_y =
          UndistortPixel(camera, {1.0 * x, y + 0.5}) - UndistortPixel(camera, {1.0 * x, y - 0.5});
      double sum = 0.0;
      for (int j = 0; j < kSamples; ++j) {
        for (int i = 0; i < kSamples; ++i) {
          const double at_x = (i + 0.5) / kSamples - 0.5, at_y = (j + 0.5) / kSamples - 0.5;
          double value = options.background;
          for (const MarkerUnderRays* print : near) {
            const double printed = (*print)(ray + d_x * at_x + d_y * at_y);
            if (printed >= 0.0) value = printed;
          }
          if (options.light) value *= options.light({x + at_x, y + at_y});
          if (options.glare) value += options.glare({x + at_x, y + at_y});
          sum += value;
        }
      }
      light(x, y) = sum / (kSamples * kSamples);
    }
  }
  if (options.blur_px > 0.0) light = Blurred(light, options.blur_px);
  std::mt19937 random(options.seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  GreyImage image(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      double code = 255.0 * SrgbFromLinear(light(x, y));
      if (options.noise_codes > 0.0) code += options.noise_codes * noise(random);
      image(x, y) = static_cast<std::uint8_t>(std::clamp(code + 0.5, 0.0, 255.0));
    }
  }
  return image;
}

std::array<Vec2, 4> TrueCorners(const CameraModel& camera, const RenderedMarker& marker) {
  return accuracy::SquareCorners(camera, marker.camera_from_marker, marker.size);
}

}  // namespace pleinair::tracker
