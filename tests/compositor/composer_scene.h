#pragma once

// A small scene whose light can be calculated by hand: a cube on the ground, seen from above.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/camera_image.h"
#include "base/srgb.h"
#include "compositor/composer.h"
#include "compositor/light/light_solver.h"

namespace pleinair::compositor {

inline constexpr double kSkyLux = 20000, kSunLux = 80000;

/// A uniform sky with or without a sun in the south, 45° high.
class SouthernSun : public sky::SkyModel {
 public:
  explicit SouthernSun(double sun_lux = kSunLux) : sun_lux_(sun_lux) {}
  LinearRgb SkyRadiance(Direction<World>) const override {
    return LinearRgb{kSkyLux, kSkyLux, kSkyLux} * std::numbers::inv_pi;
  }
  LinearRgb SunNormalIrradiance() const override { return {sun_lux_, sun_lux_, sun_lux_}; }
  LinearRgb SkyHorizontalIrradiance() const override { return {kSkyLux, kSkyLux, kSkyLux}; }
  Direction<World> ToSun() const override {
    return {{0, -std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2}};
  }

 private:
  double sun_lux_;
};

/// The same light in air that transmits half of the light over `halving_m`.
class HazySouthernSun : public SouthernSun {
 public:
  explicit HazySouthernSun(double halving_m) : halving_m_(halving_m) {}
  AirBetween AirTo(Direction<World>, Metres distance) const override {
    const double left = std::exp2(-distance.value() / halving_m_);
    return {{left, left, left}, LinearRgb{1.0, 1.0, 1.0} * (kAirlight * (1.0 - left))};
  }
  static constexpr double kAirlight = 6000.0;

 private:
  double halving_m_;
};

/// An axis-aligned box; with zero height a rectangle that faces up.
inline Model MakeBox(Vec3 low, Vec3 high, float albedo) {
  Model model;
  Material material;
  material.base_color = {albedo, albedo, albedo};
  model.materials.push_back(material);
  Mesh mesh;
  const auto face = [&](Vec3 origin, Vec3 u, Vec3 v) {
    const Vec3 normal = Normalized(Cross(u, v));
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3 p : {origin, origin + u, origin + u + v, origin + v}) {
      mesh.positions.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
      mesh.normals.push_back({static_cast<float>(normal.x), static_cast<float>(normal.y),
                              static_cast<float>(normal.z)});
    }
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + i);
  };
  const Vec3 dx{high.x - low.x, 0, 0}, dy{0, high.y - low.y, 0}, dz{0, 0, high.z - low.z};
  face(low + dz, dx, dy);
  if (dz.z > 0.0) {
    face(low, dy, dx);
    face(low, dx, dz);
    face(low + dx, dy, dz);
    face(low + dx + dy, dx * -1.0, dz);
    face(low + dy, dy * -1.0, dz);
  }
  model.meshes.push_back(std::move(mesh));
  return model;
}

inline PlacedModel Place(const Model& model, bool is_phantom) {
  return {std::make_shared<const Model>(model), Mat3{}, {}, is_phantom};
}

inline const CameraModel kCamera{
    .width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 159.5, .cy = 119.5};
// Three metres above the marker, looking straight down; image up is the marker's +y (north).
inline const Transform<Camera, Marker> kFromAbove{{{1, 0, 0, 0, -1, 0, 0, 0, -1}}, {0, 0, 3}};
// Linear value per radiance: white ground in full light has 0.8.
inline const double kExposureScale =
    0.8 * std::numbers::pi / (kSkyLux + kSunLux * std::numbers::sqrt2 / 2);

inline const PlacedModel kGround = Place(MakeBox({-4, -4, 0}, {4, 4, 0}, 0.3F), true);
inline const PlacedModel kCube =
    Place(MakeBox({-0.15, -0.15, 0.001}, {0.15, 0.15, 0.3}, 0.5F), false);

/// A composer of a scene in this light.
inline std::unique_ptr<Composer> LitComposer(const std::vector<PlacedModel>& scene,
                                             const sky::SkyModel& light,
                                             const CameraModel& camera = kCamera,
                                             const ComposerOptions& options = {}) {
  LightSolverOptions solver_options;
  solver_options.rays_per_vertex = 64;
  const auto solver = LightSolver::Create(scene, solver_options);
  if (!solver) ADD_FAILURE() << solver.error().Message();
  auto composer = Composer::Create(camera, scene, options);
  if (!composer) ADD_FAILURE() << composer.error().Message();
  const auto set = (*composer)->SetLight((*solver)->Solve(light, Mat3{}), light, Mat3{},
                                         (*solver)->RadianceFromBelow(light, Mat3{}));
  if (!set) ADD_FAILURE() << set.error().Message();
  return *std::move(composer);
}

inline RgbImage Compose(const std::vector<PlacedModel>& scene, CameraImageView picture,
                        const CameraModel& camera = kCamera, double sun_lux = kSunLux,
                        ComposerOptions options = {}, const std::optional<CameraLook>& look = {},
                        bool assume_unmodelled_shadows = true) {
  const auto composer = LitComposer(scene, SouthernSun(sun_lux), camera, options);
  composer->AssumeUnmodelledShadows(assume_unmodelled_shadows);
  if (const auto looks = composer->SetCameraLook(look); !looks) {
    ADD_FAILURE() << looks.error().Message();
  }
  auto composed =
      composer->Compose(picture, kFromAbove, {kExposureScale, kExposureScale, kExposureScale});
  if (!composed) ADD_FAILURE() << composed.error().Message();
  return *std::move(composed);
}

inline RgbImage Compose(const std::vector<PlacedModel>& scene, const RgbImage& picture,
                        const CameraModel& camera = kCamera, double sun_lux = kSunLux,
                        ComposerOptions options = {}, const std::optional<CameraLook>& look = {},
                        bool assume_unmodelled_shadows = true) {
  return Compose(scene, CameraImageView(picture.view()), camera, sun_lux, options, look,
                 assume_unmodelled_shadows);
}

inline RgbImage EvenPicture(std::uint8_t code) {
  RgbImage picture(kCamera.width, kCamera.height, 3);
  std::fill_n(picture.data(), picture.size(), code);
  return picture;
}

/// Linear value of the green channel at the projection of a scene point.
inline double SeenAt(const RgbImage& picture, Vec3 point, const CameraModel& camera = kCamera) {
  const Vec2 pixel = ProjectToPixel(camera, kFromAbove * Point<Marker>{point});
  return LinearFromSrgb8()[picture(static_cast<int>(std::lround(pixel.x)),
                                   static_cast<int>(std::lround(pixel.y)), 1)];
}

inline const double kLevelLux = kSkyLux + kSunLux * std::numbers::sqrt2 / 2;
/// Linear value of a level face with this reflectance.
inline double Level(double albedo) {
  return kExposureScale * albedo * kLevelLux * std::numbers::inv_pi;
}

/// Share of the background light that a scene of black surfaces transmits; mean over the centre of
/// the image.
inline double LetThrough(const std::vector<PlacedModel>& scene,
                         const CameraModel& camera = kCamera) {
  constexpr std::uint8_t kBehind = 200;
  RgbImage picture(camera.width, camera.height, 3);
  std::fill_n(picture.data(), picture.size(), kBehind);
  const RgbImage composed = Compose(scene, picture, camera);
  double sum = 0.0;
  const int half = camera.width / 20, middle_x = camera.width / 2, middle_y = camera.height / 2;
  for (int y = middle_y - half; y < middle_y + half; ++y) {
    for (int x = middle_x - half; x < middle_x + half; ++x) {
      sum += LinearFromSrgb8()[composed(x, y, 1)];
    }
  }
  return sum / (4 * half * half) / LinearFromSrgb8()[kBehind];
}

/// Draws the scene in the southern sun without a test for unmodelled shadows. Pixels that no object
/// shades are then not tested for sun visibility.
inline std::unique_ptr<Composer> ComposerInTheSun(const std::vector<PlacedModel>& scene) {
  static const SouthernSun light;
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 64});
  auto composer = Composer::Create(kCamera, scene, {});
  EXPECT_TRUE(composer.value()->SetLight(solver.value()->Solve(light, Mat3{}), light, Mat3{},
                                         solver.value()->RadianceFromBelow(light, Mat3{})));
  composer.value()->AssumeUnmodelledShadows(false);
  return std::move(composer.value());
}

}  // namespace pleinair::compositor
