#include "app/replay/time_lapse/day_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "base/parallel_for.h"
#include "base/quantile.h"
#include "base/srgb.h"
#include "compositor/light/sky_table.h"
#include "scene/sun_over_place.h"
#include "session/clouds/cloud_shadow.h"
#include "session/clouds/clouded_day.h"
#include "session/scene_animation.h"
#include "shadows/shadow_uniforms.h"
#include "sky/clouds/cloud_sky.h"

namespace pleinair::app {
namespace {

// White paper on the ground has this display-linear value in the brightest moment.
constexpr double kWhite = 0.8, kPaper = 0.8;
// Exponent of the visible dimming: the fifth root of the light's decrease.
constexpr double kDimming = 0.2;
// Below this illuminance, lux, a daylight camera shows black.
constexpr double kDark_lux = 0.05;

/// Share of the sun that the sunniest tenth of the layers' area has. The wind does not change it.
double SunInGaps(const clouds::CloudFields& fields, Direction<World> to_sun) {
  constexpr int kSide = 20;
  std::vector<double> shares;
  shares.reserve(static_cast<std::size_t>(kSide) * kSide);
  for (int i = 0; i < kSide * kSide; ++i) {
    const int column = i % kSide, row = i / kSide;
    const Vec3 point{((column + 0.5) / kSide - 0.5) * clouds::kCoverSquare_m,
                     ((row + 0.5) / kSide - 0.5) * clouds::kCoverSquare_m, 0.0};
    shares.push_back(clouds::PointSunTransmittance(fields, point, to_sun, 0.0));
  }
  return Quantile(std::move(shares), 0.9);
}

/// Land of a reflectance beyond the phantoms: level, in the plane of the marker.
LinearRgb LandSeen(const session::BakedLighting& light, Vec3 eye_m, Direction<World> along,
                   double seconds) {
  // Farther land has no shadows of its own: they are too flat to be seen apart.
  constexpr double kFarthest_m = 10'000.0;
  const Vec3 to_sun = light.daylight.ToSun().xyz;
  const double distance = std::min(std::max(eye_m.z, 0.0) / -along.xyz.z, kFarthest_m);
  const double share = clouds::PointSunTransmittance(
      light.request.clouds, eye_m + along.xyz * distance, {to_sun}, seconds);
  const LinearRgb lux = light.daylight.SkyHorizontalIrradiance() +
                        light.daylight.SunNormalIrradiance() * (std::max(0.0, to_sun.z) * share);
  return lux * (compositor::kLandAlbedo / std::numbers::pi);
}

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
  auto model = session::ClearSkyOf(request_, sun);
  if (!request_.clouds.empty()) {
    model = session::WithScaledSky(std::move(model), request_.skies.scale);
    const clouds::AreaLight area =
        clouds::ComputeAreaLight(request_.clouds, *model, compositor::kLandAlbedo, 0.0);
    return area.sky_horizontal +
           model->SunNormalIrradiance() *
               (std::max(0.0, sun.ToSun().xyz.z) * SunInGaps(request_.clouds, sun.ToSun()));
  }
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
  PLEINAIR_RETURN_IF_ERROR(ShadeByClouds(light));
  session::PlayAnimations(placed_, request_.time, time, composer_.get());
  return composer_->Compose(Far(light, camera_from_marker, exposure_scale).view(),
                            camera_from_marker, exposure_scale);
}

Result<void> DayRenderer::ShadeByClouds(const session::BakedLighting& light) {
  if (!light.clouded) return {};
  const session::CloudShadow shadow = session::MakeCloudShadow(
      light.request.clouds, session::BoxOf(light.meshes, light.marker_from_world),
      light.daylight.ToSun(), light.marker_from_world,
      light.request.CloudSeconds(light.request.time));
  PLEINAIR_RETURN_IF_ERROR(composer_->SetSunTransmittance({.clouds = shadow.map}));
  return composer_->SetLightMix(light.meshes, {.sun = {shadow.sun, shadow.sun, shadow.sun}});
}

/// The background of the scene: sky and land.
RgbImage DayRenderer::Far(const session::BakedLighting& light,
                          const Transform<Camera, Marker>& camera_from_marker,
                          LinearRgb exposure_scale) const {
  const compositor::SkyTable sky(light.daylight, light.marker_from_world, compositor::kLandAlbedo);
  const auto marker_from_camera = camera_from_marker.Inverse();
  const Mat3 world_from_marker = light.marker_from_world.Transposed();
  const Vec3 eye_m = world_from_marker * marker_from_camera.translation_m;
  const double seconds = light.request.CloudSeconds(light.request.time);
  const auto radiance = [&](Vec3 ray) -> LinearRgb {
    const Vec3 along = marker_from_camera.rotation * ray;
    if (!light.clouded) {
      const auto seen = sky.Radiance(along);
      return {seen[0], seen[1], seen[2]};
    }
    const Direction<World> world{world_from_marker * along};
    return world.xyz.z > 0.0 ? light.clouded->RadianceSeen(world)
                             : LandSeen(light, eye_m, world, seconds);
  };
  RgbImage picture(width_, height_, 3);
  ParallelFor(static_cast<std::size_t>(height_), 0, [&](std::size_t row) {
    std::uint8_t* at = picture.view().row(static_cast<int>(row));
    for (int x = 0; x < width_; ++x) {
      const LinearRgb shown =
          radiance(rays_[row * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)]) *
          exposure_scale;
      *at++ = Srgb8FromLinear(shown.r);
      *at++ = Srgb8FromLinear(shown.g);
      *at++ = Srgb8FromLinear(shown.b);
    }
  });
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
