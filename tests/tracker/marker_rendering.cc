#include "tests/tracker/marker_rendering.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/srgb.h"
#include "tracker/homography.h"

namespace pleinair::tracker {
namespace {

constexpr int kSamples = 12;

Mat3 RotationAbout(Vec3 axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), t = 1.0 - c;
  const auto [x, y, z] = axis;
  return {{t * x * x + c, t * x * y - s * z, t * x * z + s * y, t * x * y + s * z, t * y * y + c,
           t * y * z - s * x, t * x * z - s * y, t * y * z + s * x, t * z * z + c}};
}

/// Light of the print where a ray (undistorted, z = 1) meets it; negative beside it.
class PrintUnderRays {
 public:
  explicit PrintUnderRays(const RenderedMarker& marker) : marker_(marker) {
    const Transform<Camera, Marker>& pose = marker.camera_from_marker;
    const double half = 0.5 * marker.size.value();
    Mat3 rays_from_print;
    for (int row = 0; row < 3; ++row) {
      const double t = row == 0   ? pose.translation_m.x
                       : row == 1 ? pose.translation_m.y
                                  : pose.translation_m.z;
      rays_from_print(row, 0) = pose.rotation(row, 0) * half;
      rays_from_print(row, 1) = pose.rotation(row, 1) * half;
      rays_from_print(row, 2) = t;
    }
    print_from_rays_ = Adjugate(rays_from_print);
  }

  double operator()(Vec2 ray) const {
    const Vec2 at = Apply(print_from_rays_, ray);
    const PrintPattern& pattern = *marker_.pattern;
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
  Mat3 print_from_rays_;
};

/// Pixels that may see a print.
struct PixelBox {
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;

  bool Holds(int x, int y) const { return x >= left && x <= right && y >= top && y <= bottom; }
};

PixelBox BoxOf(const CameraModel& camera, const RenderedMarker& marker) {
  constexpr int kSteps = 16;          // Along a side, since lenses bend sides.
  constexpr double kMargin_px = 3.0;  // A pixel's own width, and what bends between two steps.
  constexpr double kAll = 1e9;
  const double half = 0.5 * marker.size.value() * marker.pattern->Extent();
  PixelBox box;
  for (int side = 0; side < 4; ++side) {
    for (int step = 0; step < kSteps; ++step) {
      const double along = step / static_cast<double>(kSteps);
      const Vec2 from = kSquareCorners[side], to = kSquareCorners[(side + 1) % 4];
      const Vec2 at = (from * (1.0 - along) + to * along) * half;
      const Point<Camera> point = marker.camera_from_marker * Point<Marker>{{at.x, at.y, 0.0}};
      // Partly behind the camera: it may be seen anywhere.
      if (point.xyz.z < 1e-6) return {-kAll, kAll, -kAll, kAll};
      const Vec2 pixel = ProjectToPixel(camera, point);
      box = {std::min(box.left, pixel.x - kMargin_px), std::max(box.right, pixel.x + kMargin_px),
             std::min(box.top, pixel.y - kMargin_px), std::max(box.bottom, pixel.y + kMargin_px)};
    }
  }
  return box;
}

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
  std::vector<PrintUnderRays> prints(markers.begin(), markers.end());
  std::vector<PixelBox> boxes;
  for (const RenderedMarker& marker : markers) boxes.push_back(BoxOf(camera, marker));
  std::vector<const PrintUnderRays*> near;
  Image<double> light(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      near.clear();
      for (std::size_t i = 0; i < prints.size(); ++i) {
        if (boxes[i].Holds(x, y)) near.push_back(&prints[i]);
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
          for (const PrintUnderRays* print : near) {
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
  GreyImage picture(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      double code = 255.0 * SrgbFromLinear(light(x, y));
      if (options.noise_codes > 0.0) code += options.noise_codes * noise(random);
      picture(x, y) = static_cast<std::uint8_t>(std::clamp(code + 0.5, 0.0, 255.0));
    }
  }
  return picture;
}

std::array<Vec2, 4> TrueCorners(const CameraModel& camera, const RenderedMarker& marker) {
  std::array<Vec2, 4> corners;
  for (int i = 0; i < 4; ++i) {
    const Vec2 corner = kSquareCorners[i] * (0.5 * marker.size.value());
    corners[i] = ProjectToPixel(
        camera, marker.camera_from_marker * Point<Marker>{{corner.x, corner.y, 0.0}});
  }
  return corners;
}

Transform<Camera, Marker> PoseSeenAt(const CameraModel& camera, Vec2 centre_px, double side_px,
                                     Metres size, Radians tilt, Radians tilt_axis, Radians roll) {
  const Vec2 ray = UndistortPixel(camera, centre_px);
  const Vec3 direction = Normalized(Vec3{ray.x, ray.y, 1.0});
  // Smallest turn that takes the optical axis to the line of sight.
  const Vec3 cross = Cross({0, 0, 1}, direction);
  const double sine = Norm(cross);
  const Mat3 facing =
      sine > 1e-12 ? RotationAbout(cross * (1.0 / sine), std::atan2(sine, direction.z)) : Mat3{};
  // The marker's y is up and its z towards the viewer: half a turn about x from the camera's axes.
  constexpr Mat3 kUpright{{1, 0, 0, 0, -1, 0, 0, 0, -1}};
  const Mat3 tilted =
      RotationAbout({std::cos(tilt_axis.value()), std::sin(tilt_axis.value()), 0.0}, tilt.value());
  return {facing * tilted * RotationAbout({0, 0, 1}, roll.value()) * kUpright,
          direction * (camera.fx * size.value() / side_px)};
}

}  // namespace pleinair::tracker
