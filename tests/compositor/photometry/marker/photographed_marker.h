#pragma once

// A marker photographed from above in known light, and its exposure estimator.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "compositor/photometry/marker/marker_light_meter.h"

namespace pleinair::compositor::testing {

inline constexpr double kAmbientLux = 12000, kSunLux = 80000;

/// Light from directly above and a uniform sky.
class OverheadSun : public sky::SkyModel {
 public:
  LinearRgb SkyRadiance(Direction<World>) const override { return {1, 1, 1}; }
  LinearRgb SunNormalIrradiance() const override { return {kSunLux, kSunLux, kSunLux}; }
  LinearRgb SkyHorizontalIrradiance() const override {
    return {kAmbientLux, kAmbientLux, kAmbientLux};
  }
  Direction<World> ToSun() const override { return {{0, 0, 1}}; }
};

/// Phantoms whose shadow covers the marker where x is below `shadow_to_x_m`.
class HalfShadow : public PhantomRays {
 public:
  explicit HalfShadow(double shadow_to_x_m) : shadow_to_x_m_(shadow_to_x_m) {}
  double SunVisibility(Point<Marker> point, Vec3) const override {
    return point.xyz.x < shadow_to_x_m_ ? 0.0 : 1.0;
  }
  bool IsUnoccluded(Point<Marker>, Vec3) const override { return true; }
  std::optional<PhantomSurface> First(Point<Marker>, Vec3) const override { return {}; }
  std::vector<LinearRgb> Ambient(std::span<const FacingPoint> points, const sky::SkyModel&,
                                 const Mat3&, std::uint32_t) const override {
    return std::vector<LinearRgb>(points.size(), {kAmbientLux, kAmbientLux, kAmbientLux});
  }

 private:
  double shadow_to_x_m_;
};

inline const scene::MarkerReflectance kMarker{
    .size_m = 0.4, .board_size_m = 0.5, .black_band_m = 0.05};
inline const CameraModel kCamera{
    .width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 160, .cy = 120};
// One metre above the marker, looking straight down.
inline const Transform<Camera, Marker> kFromAbove{{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0, 0, 1}};

/// The marker in the light of OverheadSun, shaded left of `shadow_to_x_m`, with uniform veiling
/// glare.
inline RgbImage Photograph(LinearRgb exposure_scale, double shadow_to_x_m, double veil = 0.0,
                           const scene::MarkerReflectance& marker = kMarker,
                           const CameraResponse& response = {}) {
  RgbImage picture(kCamera.width, kCamera.height, 3);
  for (int y = 0; y < kCamera.height; ++y) {
    for (int x = 0; x < kCamera.width; ++x) {
      const Vec2 ray = UndistortPixel(kCamera, {static_cast<double>(x), static_cast<double>(y)});
      const double distance = std::max(std::fabs(ray.x), std::fabs(ray.y));
      const double albedo =
          distance < marker.size_m / 2 ? marker.albedo_black : marker.albedo_white;
      const double lux = kAmbientLux + (ray.x < shadow_to_x_m ? 0.0 : kSunLux);
      const double radiance = albedo * lux / std::numbers::pi;
      picture(x, y, 0) = response.Encoded8(exposure_scale.r * radiance + veil, 0);
      picture(x, y, 1) = response.Encoded8(exposure_scale.g * radiance + veil, 1);
      picture(x, y, 2) = response.Encoded8(exposure_scale.b * radiance + veil, 2);
    }
  }
  return picture;
}

inline MarkerLightMeter MeterFor(double predicted_shadow_to_x_m,
                                 const CameraResponse& response = {}) {
  return MarkerLightMeter(kMarker, HalfShadow(predicted_shadow_to_x_m), OverheadSun(), Mat3{},
                          response);
}

inline const LinearRgb kExposureScale{3.0e-5, 2.5e-5, 2.0e-5};

inline void ExpectExposureScale(const std::optional<ExposureEstimate>& estimate,
                                LinearRgb exposure_scale) {
  ASSERT_TRUE(estimate.has_value());
  EXPECT_NEAR(estimate->exposure_scale.r / exposure_scale.r, 1.0, 0.02);
  EXPECT_NEAR(estimate->exposure_scale.g / exposure_scale.g, 1.0, 0.02);
  EXPECT_NEAR(estimate->exposure_scale.b / exposure_scale.b, 1.0, 0.02);
}

}  // namespace pleinair::compositor::testing
