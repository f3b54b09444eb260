#include "app/scene_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/progress_bar.h"
#include "compositor/marker_print.h"
#include "compositor/scaled_daylight.h"
#include "compositor/shadow_contrast.h"
#include "compositor/shadow_heading.h"

namespace pleinair::app {
namespace {

// The sun moves its own width in about two minutes; the light among surfaces is made anew
// after half of that, the sun itself moves in every frame.
constexpr double kSunStep = 0.25 * kRadiansPerDegree;
// Frames over which the exposure is a running median: long enough to still a flickering reading,
// short enough to follow a camera's automatic exposure.
constexpr std::size_t kGainWindow = 15;
// Where no marker could be read, the gain is guessed so that white paper on the ground shows as
// this display-linear value.
constexpr double kGuessedWhite = 0.8;

using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

compositor::NormalsMode NormalsOf(devices::Shading shading) {
  switch (shading) {
    case devices::Shading::kFromFile:
      return compositor::NormalsMode::kFromFile;
    case devices::Shading::kFlat:
      return compositor::NormalsMode::kFlat;
    case devices::Shading::kSmooth:
      return compositor::NormalsMode::kSmooth;
  }
  return compositor::NormalsMode::kFromFile;
}

/// Rotation about x, then y, then z.
Mat3 RotationXyz(Vec3 degrees) {
  const auto about = [](int axis, double angle_deg) {
    const double c = std::cos(angle_deg * kRadiansPerDegree);
    const double s = std::sin(angle_deg * kRadiansPerDegree);
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    Mat3 rotation;
    rotation(i, i) = c;
    rotation(i, j) = -s;
    rotation(j, i) = s;
    rotation(j, j) = c;
    return rotation;
  };
  return about(2, degrees.z) * about(1, degrees.y) * about(0, degrees.x);
}

double MedianOf(const std::deque<LinearRgb>& gains, double LinearRgb::*channel) {
  std::vector<double> values;
  for (const LinearRgb& gain : gains) values.push_back(gain.*channel);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Result<compositor::PlacedModel> PlaceModel(const devices::ModelReference& reference,
                                           bool is_phantom) {
  PLEINAIR_ASSIGN_OR_RETURN(compositor::Model model,
                            compositor::LoadModel(reference.file, {NormalsOf(reference.shading)}));
  Mat3 linear = RotationXyz(reference.rotation_deg);
  for (double& element : linear.m) element *= reference.scale;
  return compositor::PlacedModel{std::make_shared<const compositor::Model>(std::move(model)),
                                 linear, reference.translation_m, is_phantom};
}

/// What the frames looked at have shown so far.
struct SceneRenderer::Look {
  sky::SunPosition sun;
  std::unique_ptr<sky::SkyModel> day;  ///< With a sun, whatever the scene says.
  compositor::SurfaceSamples samples;
  compositor::LightMeter meter;
  LinearRgb gain{1.0, 1.0, 1.0};  ///< Of the last frame that could be metered.
};

Mat3 MarkerFromWorld(const devices::MarkerDescription& marker) {
  const double s = std::sin(marker.heading.value()), c = std::cos(marker.heading.value());
  if (marker.upright) return {{c, -s, 0, 0, 0, 1, -s, -c, 0}};
  return {{c, -s, 0, s, c, 0, 0, 0, 1}};
}

SceneRenderer::SceneRenderer(const CameraModel& camera, const devices::SceneDescription& scene)
    : camera_(camera), scene_(scene) {}

SceneRenderer::~SceneRenderer() = default;

Result<std::unique_ptr<SceneRenderer>> SceneRenderer::Create(
    const CameraModel& camera, const devices::SceneDescription& scene,
    const compositor::ComposerOptions& options, const LightOverrides& overrides) {
  std::unique_ptr<SceneRenderer> renderer(new SceneRenderer(camera, scene));
  renderer->overrides_ = overrides;
  if (overrides.heading_deg) renderer->scene_.marker.heading = FromDegrees(*overrides.heading_deg);
  std::vector<compositor::PlacedModel> placed;
  for (const devices::ModelReference& phantom : scene.phantoms) {
    PLEINAIR_ASSIGN_OR_RETURN(auto model, PlaceModel(phantom, true));
    placed.push_back(std::move(model));
  }
  for (const devices::ModelReference& object : scene.objects) {
    PLEINAIR_ASSIGN_OR_RETURN(auto model, PlaceModel(object, false));
    placed.push_back(std::move(model));
  }
  if (scene.objects.empty()) return renderer;
  renderer->skies_ = StatedSky(scene);
  PLEINAIR_ASSIGN_OR_RETURN(renderer->composer_,
                            compositor::Composer::Create(camera, placed, options));
  PLEINAIR_ASSIGN_OR_RETURN(renderer->solver_,
                            compositor::LightSolver::Create(std::move(placed), {}));
  return renderer;
}

struct SceneRenderer::Light {
  sky::SunPosition sun;
  std::shared_ptr<const sky::SkyModel> model;
  compositor::ScaledDaylight daylight;
  std::vector<compositor::LitMesh> meshes;
};

void SceneRenderer::SetMarkerPrint(const compositor::MarkerPrint& print) {
  print_ = print;
  if (!lit_) return;
  meter_.emplace(print_, *solver_, lit_->daylight, MarkerFromWorld(scene_.marker));
}

sky::SunPosition SceneRenderer::SunAt(UtcTime time) const {
  const sky::Observer observer{FromDegrees(scene_.place_time.latitude_deg),
                               FromDegrees(scene_.place_time.longitude_deg),
                               Metres(scene_.place_time.height_m)};
  return sky::ComputeSunPosition(observer, time);
}

bool SceneRenderer::CanMeasureLight() const {
  return composer_ && !overrides_.as_stated && !scene_.phantoms.empty() &&
         !(overrides_.sun_to_sky && overrides_.heading_deg);
}

void SceneRenderer::LookAtLight(ImageView<const std::uint8_t> rgb,
                                const Transform<Camera, Marker>& camera_from_marker, UtcTime time) {
  if (!look_) {
    const sky::SunPosition sun = SunAt(time);
    auto day = SunlitSky(scene_)->ForSun(sun.ToSun(), sun.distance_au);
    compositor::LightMeter meter(print_, *solver_, *day, MarkerFromWorld(scene_.marker));
    look_.reset(new Look{sun, std::move(day), {*solver_, camera_, print_}, std::move(meter), {}});
    look_->gain = {1.0, 1.0, 1.0};
  }
  if (const auto reading = look_->meter.Measure(rgb, camera_, camera_from_marker)) {
    look_->gain = reading->gain;
  }
  look_->samples.AddFrame(rgb, camera_from_marker, look_->gain);
}

void SceneRenderer::SettleLight() {
  if (!look_) return;
  const std::unique_ptr<Look> look = std::move(look_);
  MeasuredLight& light = summary_.measured;
  light.frames = look->samples.frames();
  Mat3 marker_from_world = MarkerFromWorld(scene_.marker);
  const Vec3 to_sun = marker_from_world * look->day->ToSun().xyz;
  const Vec3 up = marker_from_world * Vec3{0.0, 0.0, 1.0};
  const double stated_heading = scene_.marker.heading.value();
  if (!overrides_.heading_deg) {
    if (const auto heading = compositor::ReadHeading(*solver_, look->samples, up, to_sun)) {
      WeighHeading(*heading, &light);
      scene_.marker.heading = Radians(stated_heading + light.heading_offset.value());
      marker_from_world = MarkerFromWorld(scene_.marker);
    }
  }
  const compositor::SunSkyReading reading = compositor::ReadSunAndSky(
      compositor::FindShadowEdges(*solver_, look->samples, *look->day, marker_from_world));
  light.edges = reading.edges;
  light.edges_agreeing = reading.agreeing;
  using Sun = compositor::SunSkyReading::Sun;
  if (reading.sun != Sun::kShines && light.heading_source == MeasuredLight::Source::kMeasured) {
    // Without a sun it was not shadows that the heading was read from.
    scene_.marker.heading = Radians(stated_heading);
    light.heading_offset = light.heading_error = {};
    light.heading_source = MeasuredLight::Source::kStated;
  }
  if (overrides_.sun_to_sky || reading.sun == Sun::kUnknown) return;
  light.sun_source = MeasuredLight::Source::kMeasured;
  if (reading.sun == Sun::kHidden) {
    skies_ = OvercastSky();
    return;
  }
  const LinearRgb scale = WeighedScale(reading, scene_.cloudiness, &light.sun_to_sky_error);
  const LinearRgb share =
      look->day->SkyHorizontalIrradiance() / look->day->SunNormalIrradiance() * scale;
  const MeasuredSky measured = SkyWithShare(share, look->day->ToSun(), look->sun.distance_au);
  skies_ = measured.skies;
  sky_scale_ = measured.sky_scale;
}

/// What the user says counts, for the first sun that is rendered.
void SceneRenderer::OverrideLight(const sky::SunPosition& sun) {
  MeasuredLight& light = summary_.measured;
  light.sun_to_sky_stated = SunToSky(*StatedSky(scene_)->ForSun(sun.ToSun(), sun.distance_au));
  if (overrides_.heading_deg) {
    light.heading_source = MeasuredLight::Source::kOverride;
  }
  if (!overrides_.sun_to_sky) return;
  light.sun_source = MeasuredLight::Source::kOverride;
  const double wanted = *overrides_.sun_to_sky;
  const Vec3 to_sun = sun.ToSun().xyz;
  if (wanted <= 0.0 || to_sun.z <= 0.0) {
    skies_ = OvercastSky();
    return;
  }
  const auto day = SunlitSky(scene_)->ForSun(sun.ToSun(), sun.distance_au);
  const LinearRgb share = day->SkyHorizontalIrradiance() / day->SunNormalIrradiance();
  const MeasuredSky measured =
      SkyWithShare(share * (SunToSky(*day) / wanted), sun.ToSun(), sun.distance_au);
  skies_ = measured.skies;
  sky_scale_ = measured.sky_scale;
}

/// Traces where each surface's light comes from, once for all skies, where that is to be kept.
void SceneRenderer::TraceLight() {
  if (light_cache_.empty() || coefficients_) return;
  constexpr int kSteps = 100;
  ProgressBar bar("Tracing light", kSteps, "%");
  int done = 0;
  const auto advance = [&](double share) {
    for (; done < static_cast<int>(share * kSteps); ++done) bar.Advance();
  };
  compositor::CoefficientOptions options;
  options.cache = light_cache_;
  coefficients_ =
      solver_->Coefficients(MarkerFromWorld(scene_.marker) * Vec3{0.0, 0.0, 1.0}, options, advance);
}

std::vector<compositor::LitMesh> SceneRenderer::LightAmongSurfaces(
    const sky::SkyModel& daylight, const Mat3& marker_from_world) const {
  if (!coefficients_) return solver_->Solve(daylight, marker_from_world);
  return solver_->Relight(*coefficients_, daylight, marker_from_world);
}

bool SceneRenderer::NeedsLight(UtcTime made, UtcTime now) const {
  return composer_ && Norm(SunAt(made).ToSun().xyz - SunAt(now).ToSun().xyz) >= kSunStep;
}

std::shared_ptr<const SceneRenderer::Light> SceneRenderer::PrepareLight(UtcTime time) const {
  if (!composer_) return nullptr;
  const sky::SunPosition sun = SunAt(time);
  std::shared_ptr<const sky::SkyModel> model = skies_->ForSun(sun.ToSun(), sun.distance_au);
  const compositor::ScaledDaylight daylight(*model, sky_scale_, {1.0, 1.0, 1.0});
  return std::shared_ptr<const Light>(new Light{
      sun, model, daylight, LightAmongSurfaces(daylight, MarkerFromWorld(scene_.marker))});
}

Result<void> SceneRenderer::TakeLight(std::shared_ptr<const Light> light) {
  const compositor::ScaledDaylight& daylight = light->daylight;
  const Mat3 marker_from_world = MarkerFromWorld(scene_.marker);
  const LinearRgb sun = daylight.SunNormalIrradiance();
  const LinearRgb sky = daylight.SkyHorizontalIrradiance();
  summary_.sun_normal_lux = Luminance(sun);
  summary_.sky_horizontal_lux = Luminance(sky);
  summary_.measured.sun_to_sky = SunToSky(daylight);
  summary_.measured.sun_shines = Luminance(sun) > 0.0;
  const LinearRgb ground = sky + sun * std::max(0.0, light->sun.ToSun().xyz.z);
  const double white = scene_.marker.albedo_white / std::numbers::pi;
  guessed_gain_ = LinearRgb{kGuessedWhite, kGuessedWhite, kGuessedWhite} / (ground * white);
  PLEINAIR_RETURN_IF_ERROR(composer_->SetLight(light->meshes, daylight, marker_from_world));
  meter_.emplace(print_, *solver_, daylight, marker_from_world);
  lit_ = std::move(light);
  return {};
}

Result<void> SceneRenderer::UseLight(std::shared_ptr<const Light> light) {
  light_from_outside_ = true;
  return light && composer_ ? TakeLight(std::move(light)) : Result<void>();
}

Result<void> SceneRenderer::LightUp(UtcTime time) {
  light_from_outside_ = true;
  return composer_ ? UpdateLight(time) : Result<void>();
}

Result<void> SceneRenderer::UpdateLight(UtcTime time) {
  summary_.sun = SunAt(time);
  if (!lit_) OverrideLight(summary_.sun);
  const bool near = lit_ && Norm(lit_->sun.ToSun().xyz - summary_.sun.ToSun().xyz) < kSunStep;
  if (!near && !(lit_ && light_from_outside_)) {
    TraceLight();
    return TakeLight(PrepareLight(time));
  }
  const auto model = skies_->ForSun(summary_.sun.ToSun(), summary_.sun.distance_au);
  composer_->SetSun(compositor::ScaledDaylight(*model, sky_scale_, {1.0, 1.0, 1.0}),
                    MarkerFromWorld(scene_.marker));
  return {};
}

void SceneRenderer::UpdateGain(ImageView<const std::uint8_t> rgb,
                               const Transform<Camera, Marker>& camera_from_marker) {
  summary_.gain_is_guessed = false;
  if (scene_.exposure_gain) {
    summary_.gain = *scene_.exposure_gain;
    return;
  }
  if (const auto reading = meter_->Measure(rgb, camera_, camera_from_marker)) {
    recent_gains_.push_back(reading->gain);
    if (recent_gains_.size() > kGainWindow) recent_gains_.pop_front();
    summary_.gain_spread = reading->spread;
    ++summary_.readings;
  }
  if (recent_gains_.empty()) {
    summary_.gain = guessed_gain_;
    summary_.gain_is_guessed = true;
    return;
  }
  summary_.gain = {MedianOf(recent_gains_, &LinearRgb::r), MedianOf(recent_gains_, &LinearRgb::g),
                   MedianOf(recent_gains_, &LinearRgb::b)};
}

Result<RgbImage> SceneRenderer::Render(ImageView<const std::uint8_t> rgb,
                                       const Transform<Camera, Marker>& camera_from_marker,
                                       UtcTime time) {
  times_ = {};
  if (!composer_) {
    RgbImage copy(rgb.width(), rgb.height(), rgb.channels());
    for (int y = 0; y < rgb.height(); ++y) {
      std::copy_n(rgb.row(y), static_cast<std::size_t>(rgb.width()) * rgb.channels(),
                  copy.view().row(y));
    }
    return copy;
  }
  auto start = Clock::now();
  PLEINAIR_RETURN_IF_ERROR(UpdateLight(time));
  times_.light_ms = MillisecondsSince(start);
  start = Clock::now();
  UpdateGain(rgb, camera_from_marker);
  times_.meter_ms = MillisecondsSince(start);
  start = Clock::now();
  auto composed = composer_->Compose(rgb, camera_from_marker, summary_.gain);
  times_.compose_ms = MillisecondsSince(start);
  return composed;
}

}  // namespace pleinair::app
