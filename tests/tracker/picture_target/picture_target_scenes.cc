#include "tests/tracker/picture_target/picture_target_scenes.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "base/srgb.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

/// A blank marker as large as the picture's longer side, as the support of the picture.
RenderedMarker OnPaper(const HungPicture& hung, double background) {
  static const auto kPaper =
      std::make_shared<MarkerPattern>(MarkerPattern{.modules = 1, .edge_modules = 1, .white = {1}});
  RenderedMarker marker;
  marker.pattern = kPaper;
  marker.size = Metres(std::max(hung.width_m, hung.height_m()));
  marker.camera_from_marker = hung.camera_from_marker;
  const double longer = marker.size.value();
  const double across = longer / hung.width_m, along = longer / hung.height_m();
  marker.cover = [&hung, background, across, along](Vec2 at) {
    const double u = 0.5 + 0.5 * across * at.x, v = 0.5 - 0.5 * along * at.y;
    if (hung.cover) {
      const double light = hung.cover({u, v});
      if (light >= 0.0) return light;
    }
    if (!(u > 0.0 && u < 1.0 && v > 0.0 && v < 1.0)) return background;
    return 0.8 * hung.picture->LightAt(hung.mirrored ? 1.0 - u : u, v);
  };
  return marker;
}

}  // namespace

TestPicture TestPicture::FromCodes(ImageView<const std::uint8_t> codes) {
  Image<float> linear(codes.width(), codes.height());
  for (int y = 0; y < codes.height(); ++y) {
    for (int x = 0; x < codes.width(); ++x) linear(x, y) = LinearFromSrgb8()[codes(x, y)];
  }
  return TestPicture(std::move(linear));
}

GreyImage TestPicture::Codes() const {
  GreyImage codes(width(), height());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    codes.data()[i] = Srgb8FromLinear(linear_.data()[i]);
  }
  return codes;
}

double TestPicture::LightAt(double u, double v) const {
  const double x = std::clamp(u * width() - 0.5, 0.0, width() - 1.001);
  const double y = std::clamp(v * height() - 0.5, 0.0, height() - 1.001);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const double s = x - i, t = y - j;
  const double top = linear_(i, j) * (1.0 - s) + linear_(i + 1, j) * s;
  const double bottom = linear_(i, j + 1) * (1.0 - s) + linear_(i + 1, j + 1) * s;
  return top * (1.0 - t) + bottom * t;
}

TestPicture DeadLeaves(std::uint32_t seed, int width, int height) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return random() / 4294967296.0; };
  Image<float> picture(width, height);
  std::fill_n(picture.data(), picture.size(), -1.0F);
  const double largest = 0.25 * std::min(width, height), smallest = 3.0;
  std::size_t empty = picture.size();
  // From the topmost shape down: pixels that are covered already keep their value.
  for (int leaf = 0; leaf < 20'000 && empty > 0; ++leaf) {
    // Density ∝ radius⁻³ between the two limits.
    const double a = 1.0 / (smallest * smallest), b = 1.0 / (largest * largest);
    const double radius = 1.0 / std::sqrt(a + (b - a) * uniform());
    const double cx = uniform() * width, cy = uniform() * height;
    const double turn = 3.14159 * uniform(), flat = 0.4 + 0.6 * uniform();
    const bool box = uniform() < 0.4;
    const double shade = 0.04 + 0.9 * uniform() * uniform();
    const double slope_x = 0.6 * (uniform() - 0.5) / radius,
                 slope_y = 0.6 * (uniform() - 0.5) / radius, grain = 0.1 * uniform();
    const double c = std::cos(turn), s = std::sin(turn);
    const double reach = 1.5 * radius;
    for (int y = std::max(0, static_cast<int>(cy - reach));
         y < std::min<double>(height, cy + reach); ++y) {
      for (int x = std::max(0, static_cast<int>(cx - reach));
           x < std::min<double>(width, cx + reach); ++x) {
        if (picture(x, y) >= 0.0F) continue;
        const double u = c * (x - cx) + s * (y - cy), v = (c * (y - cy) - s * (x - cx)) / flat;
        if (box ? std::max(std::fabs(u), std::fabs(v)) > 0.8 * radius : std::hypot(u, v) > radius) {
          continue;
        }
        const double light = shade * (1.0 + slope_x * (x - cx) + slope_y * (y - cy)) *
                             (1.0 + grain * (2.0 * uniform() - 1.0));
        picture(x, y) = static_cast<float>(std::clamp(light, 0.01, 1.0));
        --empty;
      }
    }
  }
  for (std::size_t i = 0; i < picture.size(); ++i) {
    picture.data()[i] = std::max(picture.data()[i], 0.05F);
  }
  return TestPicture(std::move(picture));
}

HungPicture HangAt(const CameraModel& camera, const TestPicture& picture, Vec2 centre_px,
                   double side_px, double tilt_deg, double axis_deg, double roll_deg) {
  HungPicture hung;
  hung.picture = &picture;
  hung.camera_from_marker =
      PoseAtPixel(camera, centre_px, side_px, Metres(std::max(hung.width_m, hung.height_m())),
                  FromDegrees(tilt_deg), FromDegrees(axis_deg), FromDegrees(roll_deg));
  return hung;
}

GreyImage RenderPictures(const CameraModel& camera, const std::vector<HungPicture>& pictures,
                         const RenderingOptions& options) {
  std::vector<RenderedMarker> markers;
  for (const HungPicture& picture : pictures) {
    markers.push_back(OnPaper(picture, options.background));
  }
  return RenderMarkers(camera, markers, options);
}

std::array<Vec2, 4> TrueCorners(const CameraModel& camera, const HungPicture& picture) {
  std::array<Vec2, 4> corners;
  for (int i = 0; i < 4; ++i) {
    const Vec3 at{0.5 * picture.width_m * kSquareCorners[i].x,
                  0.5 * picture.height_m() * kSquareCorners[i].y, 0.0};
    corners[i] = ProjectToPixel(camera, picture.camera_from_marker * Point<Marker>{at});
  }
  return corners;
}

}  // namespace pleinair::tracker
