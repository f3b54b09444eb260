#include "app/replay/time_lapse/day_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "base/srgb.h"
#include "compositor/light/sky_table.h"
#include "scene/sun_over_place.h"
#include "session/scene_animation.h"
#include "shadows/shadow_uniforms.h"

namespace pleinair::app {
namespace {

// Albedo of the land beyond the phantoms, as in the light solver.
constexpr double kLandAlbedo = 0.2;
// White paper on the ground has this display-linear value in the brightest moment.
constexpr double kWhite = 0.8, kPaper = 0.8;
// Exponent of the visible dimming: the fifth root of the light's decrease.
constexpr double kDimming = 0.2;
// Below this illuminance, lux, a daylight camera shows black.
constexpr double kDark_lux = 0.05;

}  // namespace

DayRenderer::DayRenderer(const CameraModel& camera, session::LightingRequest request)
    : request_(std::move(request)), width_(camera.width), height_(camera.height) {
  rays_.reserve(static_cast<std::size_t>(width_) * height_);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Vec2 at = UndistortPixel(camera, {static_cast<double>(x), static_cast<double>(y)});
      rays_.push_back(Normalized({at.x, at.y, 1.0}));
    }
  }
}

Result<std::unique_ptr<DayRenderer>> DayRenderer::Create(
    const CameraModel& camera, std::vector<compositor::PlacedModel> placed,
    session::LightingRequest request, const compositor::ComposerOptions& options,
    bool phantoms_cast) {
  std::unique_ptr<DayRenderer> renderer(new DayRenderer(camera, std::move(request)));
  renderer->phantoms_cast_ = phantoms_cast;
  renderer->request_.marker_reflectance = {};  // No exposure estimation.
  for (compositor::PlacedModel& model : placed) model.is_phantom = false;
  compositor::ComposerOptions drawing = options;
  drawing.response = {};
  drawing.shadow_partitions = shadows::kMaxPartitions;  // All geometry casts shadows.
  // Map sizes for a whole scene: finer than the image size alone requires.
  constexpr std::array<int, shadows::kMaxPartitions> kSceneMaps{2048, 2048, 1024, 1024};
  for (std::size_t i = 0; i < kSceneMaps.size(); ++i) {
    if (drawing.shadow_sizes[i] == 0) drawing.shadow_sizes[i] = kSceneMaps[i];
  }
  PLEINAIR_ASSIGN_OR_RETURN(renderer->composer_,
                            compositor::Composer::Create(camera, placed, drawing));
  renderer->placed_ = std::move(placed);
  return renderer;
}

LinearRgb DayRenderer::LevelLight(UtcTime time) const {
  const sky::SunPosition sun = scene::SunOver(request_.place, time);
  const auto model = request_.skies.source->ForSun(sun.ToSun(), sun.distance_au);
  return model->SkyHorizontalIrradiance() * request_.skies.scale +
         model->SunNormalIrradiance() * std::max(0.0, sun.ToSun().xyz.z);
}

Result<RgbImage> DayRenderer::Render(const Transform<Camera, Marker>& camera_from_marker,
                                     UtcTime time, LinearRgb exposure_scale) {
  session::LightingRequest request = request_;
  request.time = time;
  session::BakedLighting light(request);
  for (compositor::LitMesh& mesh : light.meshes) {
    if (!mesh.is_phantom) continue;
    mesh.is_phantom = false;
    if (!phantoms_cast_) mesh.role = compositor::MeshRole::kRenderOnly;
    mesh.ambient_without.clear();
  }
  PLEINAIR_RETURN_IF_ERROR(
      composer_->SetLight(light.meshes, light.daylight, light.marker_from_world, light.from_below));
  session::PlayAnimations(placed_, request_.time, time, composer_.get());
  return composer_->Compose(Far(light, camera_from_marker, exposure_scale).view(),
                            camera_from_marker, exposure_scale);
}

/// The background of the scene: sky and land.
RgbImage DayRenderer::Far(const session::BakedLighting& light,
                          const Transform<Camera, Marker>& camera_from_marker,
                          LinearRgb exposure_scale) const {
  const compositor::SkyTable sky(light.daylight, light.marker_from_world, kLandAlbedo);
  const Mat3 marker_from_camera = camera_from_marker.rotation.Transposed();
  RgbImage picture(width_, height_, 3);
  auto ray = rays_.begin();
  for (int y = 0; y < height_; ++y) {
    std::uint8_t* at = picture.view().row(y);
    for (int x = 0; x < width_; ++x, ++ray) {
      const auto radiance = sky.Radiance(marker_from_camera * *ray);
      *at++ = Srgb8FromLinear(radiance[0] * exposure_scale.r);
      *at++ = Srgb8FromLinear(radiance[1] * exposure_scale.g);
      *at++ = Srgb8FromLinear(radiance[2] * exposure_scale.b);
    }
  }
  return picture;
}

LinearRgb ExposureScaleOfDay(LinearRgb level_light, LinearRgb brightest) {
  const double light = Luminance(level_light), maximum = Luminance(brightest);
  if (light < kDark_lux || maximum <= 0.0) return {};
  const double white = kWhite * std::pow(light / maximum, kDimming);
  const LinearRgb balance{maximum / brightest.r, maximum / brightest.g, maximum / brightest.b};
  return balance * (white * std::numbers::pi / (kPaper * light));
}

}  // namespace pleinair::app
