#include "session/scene_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/quantile.h"
#include "compositor/light/scaled_sky.h"
#include "devices/calibration/response_file.h"
#include "scene/marker_heading.h"
#include "scene/marker_reflectance.h"
#include "scene/sun_over_place.h"

namespace pleinair::session {
namespace {

// Blur and grain change slowly: read in every so many frames, medians over so many readings.
constexpr int kLookStep = 5;
constexpr std::size_t kLookWindow = 5;
// Where no marker could be read, the exposure scale is guessed so that white paper on the ground
// shows as this display-linear value.
constexpr double kGuessedWhite = 0.8;

using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

compositor::NormalsMode NormalsOf(scene::Shading shading) {
  switch (shading) {
    case scene::Shading::kFromFile:
      return compositor::NormalsMode::kFromFile;
    case scene::Shading::kFlat:
      return compositor::NormalsMode::kFlat;
    case scene::Shading::kSmooth:
      return compositor::NormalsMode::kSmooth;
  }
  return compositor::NormalsMode::kFromFile;
}

}  // namespace

Result<compositor::PlacedModel> PlaceModel(const scene::ModelReference& reference,
                                           bool is_phantom) {
  PLEINAIR_ASSIGN_OR_RETURN(
      compositor::Model model,
      compositor::LoadModel(reference.file, {NormalsOf(reference.shading), is_phantom}));
  return compositor::PlacedModel{
      std::make_shared<const compositor::Model>(std::move(model)),
      LinearOf({reference.translation_m, reference.rotation_deg, reference.scale}),
      reference.translation_m, is_phantom};
}

SceneRenderer::SceneRenderer(const CameraModel& camera, const scene::SceneDescription& scene)
    : camera_(camera), scene_(scene) {}

SceneRenderer::~SceneRenderer() = default;

Result<std::unique_ptr<SceneRenderer>> SceneRenderer::Create(
    const CameraModel& camera, const scene::SceneDescription& scene,
    const compositor::ComposerOptions& options, const LightOptions& light) {
  std::unique_ptr<SceneRenderer> renderer(new SceneRenderer(camera, scene));
  renderer->options_ = light;
  std::vector<compositor::PlacedModel>& placed = renderer->placed_;
  for (const scene::ModelReference& phantom : scene.phantoms) {
    PLEINAIR_ASSIGN_OR_RETURN(auto model, PlaceModel(phantom, true));
    placed.push_back(std::move(model));
  }
  for (const scene::ModelReference& object : scene.objects) {
    PLEINAIR_ASSIGN_OR_RETURN(auto model, PlaceModel(object, false));
    placed.push_back(std::move(model));
  }
  if (scene.objects.empty()) return renderer;
  renderer->skies_.source = compositor::DescribedSky(scene);
  compositor::ComposerOptions composing = options;
  if (!scene.camera_response.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(composing.response,
                              devices::ReadCameraResponse(scene.camera_response));
    renderer->response_ = composing.response;
  }
  PLEINAIR_ASSIGN_OR_RETURN(renderer->composer_,
                            compositor::Composer::Create(camera, placed, composing));
  compositor::LightSolverOptions solving;
  solving.max_patches = light.overrides.max_patches.value_or(solving.max_patches);
  PLEINAIR_ASSIGN_OR_RETURN(renderer->solver_, compositor::LightSolver::Create(placed, solving));
  return renderer;
}

void SceneRenderer::SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance) {
  marker_reflectance_ = marker_reflectance;
  if (composer_) composer_->SetMarkerMargin(marker_reflectance.board_size_m);
  if (!lit_ || light_from_outside_) return;
  meter_.emplace(marker_reflectance_, *solver_, lit_->daylight,
                 scene::MarkerFromWorld(scene_.marker), response_);
}

bool SceneRenderer::CanMeasureLight() const { return composer_ && !scene_.phantoms.empty(); }

void SceneRenderer::ObserveLight(ImageView<const std::uint8_t> rgb,
                                 const Transform<Camera, Marker>& camera_from_marker,
                                 UtcTime time) {
  if (!estimator_) {
    estimator_ = std::make_unique<compositor::LightEstimator>(
        solver_, camera_, marker_reflectance_, scene_, options_.overrides, time, response_);
  }
  estimator_->Add(rgb, camera_from_marker);
}

void SceneRenderer::EstimateLight() {
  if (!estimator_) return;
  compositor::LightFilter of_no_other_look;
  const compositor::LightEstimate found = estimator_->Estimate(&of_no_other_look);
  estimator_.reset();
  summary_.measured = found.measured;
  scene_.marker.heading = found.heading;
  if (found.skies.source) skies_ = found.skies;
}

/// What the user says counts, for the first sun that is rendered.
void SceneRenderer::OverrideLight(const sky::SunPosition& sun) {
  compositor::MeasuredLight& light = summary_.measured;
  light.sun_to_sky_stated =
      compositor::SunToSky(*compositor::DescribedSky(scene_)->ForSun(sun.ToSun(), sun.distance_au));
  if (options_.overrides.heading_deg) {
    light.heading_source = compositor::MeasuredLight::Source::kOverride;
  }
  const auto given = compositor::OverriddenSky(scene_, options_.overrides, sun);
  if (!given) return;
  light.sun_source = compositor::MeasuredLight::Source::kOverride;
  // What lies in the shade of trees was looked for under this sky.
  skies_.source = given->skies;
  skies_.scale = given->sky_radiance_scale;
}

std::shared_ptr<const compositor::DaylightCoefficients> SceneRenderer::Coefficients(
    const compositor::CoefficientProgress& progress) {
  if (coefficients_) return coefficients_;
  compositor::CoefficientOptions options;
  options.cache = options_.cache;
  options.division = options_.sky_division;
  options.convergence = options_.convergence;
  coefficients_ = std::make_shared<const compositor::DaylightCoefficients>(solver_->Coefficients(
      scene::MarkerFromWorld(scene_.marker) * Vec3{0.0, 0.0, 1.0}, options, progress));
  return coefficients_;
}

LightingRequest SceneRenderer::MakeLightingRequest(UtcTime time) const {
  return {time,    scene_.place_time, scene_.marker,       skies_,
          solver_, coefficients_,     marker_reflectance_, response_};
}

Result<void> SceneRenderer::TakeLight(std::shared_ptr<const BakedLighting> light) {
  const compositor::ScaledSky& daylight = light->daylight;
  const Mat3& marker_from_world = light->marker_from_world;
  const LinearRgb sun = daylight.SunNormalIrradiance();
  const LinearRgb sky = daylight.SkyHorizontalIrradiance();
  summary_.sun_normal_lux = Luminance(sun);
  summary_.sky_horizontal_lux = Luminance(sky);
  summary_.measured.sun_to_sky = compositor::SunToSky(daylight);
  summary_.measured.sun_shines = Luminance(sun) > 0.0;
  const LinearRgb ground = sky + sun * std::max(0.0, light->sun.ToSun().xyz.z);
  const double white = scene_.marker.albedo_white / std::numbers::pi;
  guessed_exposure_scale_ =
      LinearRgb{kGuessedWhite, kGuessedWhite, kGuessedWhite} / (ground * white);
  composer_->AssumeUnmodelledShadows(light->request.skies.unmodelled_shadows);
  PLEINAIR_RETURN_IF_ERROR(composer_->SetSunTransmittance(light->request.skies.sun_transmittance));
  PLEINAIR_RETURN_IF_ERROR(
      composer_->SetLight(light->meshes, daylight, marker_from_world, light->from_below));
  meter_ = light->meter;
  solver_ = light->request.solver;
  lit_ = std::move(light);
  MoveObjects();
  return {};
}

Result<void> SceneRenderer::PrepareLight(UtcTime time) {
  if (!composer_) return {};
  return UpdateLight(time.PlusSeconds(later_s_));
}

Result<void> SceneRenderer::UseLight(std::shared_ptr<const BakedLighting> light) {
  if (!composer_) return {};
  if (!lit_) OverrideLight(light->sun);
  light_from_outside_ = true;
  skies_ = light->request.skies;
  if (!heading_is_edited_) scene_.marker.heading = light->request.marker.heading;
  return TakeLight(std::move(light));
}

Result<void> SceneRenderer::Edit(const SceneEdit& edit) {
  scene_ = WithEdit(scene_, edit);
  later_s_ = edit.later_s;
  heading_is_edited_ = edit.heading_deg.has_value();
  lock_exposure_ = edit.lock_exposure;
  if (!composer_) return {};
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    compositor::PlacedModel& placed = placed_[scene_.phantoms.size() + i];
    placed.linear = LinearOf(edit.objects[i]);
    placed.translation_m = edit.objects[i].translation_m;
  }
  MoveObjects();
  compositor::ComposerOptions drawing = edit.drawing;
  drawing.response = response_;
  return composer_->SetOptions(drawing);
}

void SceneRenderer::LetGo() {
  if (composer_) composer_->LetGo();
}

/// Draws the objects where they stand now, lit as they were where their light was made.
void SceneRenderer::MoveObjects() {
  if (!lit_ || lit_->objects.empty()) return;
  for (std::size_t i = 0; i < lit_->objects.size(); ++i) {
    const std::size_t model = scene_.phantoms.size() + i;
    const ObjectPlace& lit = lit_->objects[i];
    // The inverse of a rotation times a scale.
    Mat3 back = LinearOf(lit).Transposed();
    for (double& element : back.m) element /= lit.scale * lit.scale;
    const Mat3 moved = placed_[model].linear * back;
    composer_->MoveModel(static_cast<int>(model), moved,
                         placed_[model].translation_m - moved * lit.translation_m);
  }
}

Result<void> SceneRenderer::UpdateLight(UtcTime time) {
  summary_.sun = scene::SunOver(scene_.place_time, time);
  if (!lit_) OverrideLight(summary_.sun);
  if (!light_from_outside_ && !(lit_ && IsNearSun(lit_->sun, summary_.sun))) {
    if (!options_.cache.empty()) Coefficients({});
    return TakeLight(std::make_shared<const BakedLighting>(MakeLightingRequest(time)));
  }
  const auto model = skies_.source->ForSun(summary_.sun.ToSun(), summary_.sun.distance_au);
  composer_->SetSun(compositor::ScaledSky(*model, skies_.scale, {1.0, 1.0, 1.0}),
                    scene::MarkerFromWorld(scene_.marker));
  return {};
}

void SceneRenderer::UpdateExposureScale(ImageView<const std::uint8_t> rgb,
                                        const Transform<Camera, Marker>& camera_from_marker) {
  using ExposureScaleSource = LightSummary::ExposureScaleSource;
  if (scene_.exposure_scale) {
    summary_.exposure_scale_source = ExposureScaleSource::kScene;
    summary_.exposure_scale = *scene_.exposure_scale;
    return;
  }
  // Held once there is a estimate to hold.
  if (lock_exposure_ && !exposure_filter_.empty()) return;
  const auto estimate = meter_ ? meter_->Measure(rgb, camera_, camera_from_marker) : std::nullopt;
  if (estimate) {
    exposure_filter_.Add(estimate->exposure_scale * skies_.marker_shade, estimate->error);
    ++summary_.exposure_estimates;
    summary_.dappled_estimates += estimate->dappled ? 1 : 0;
    summary_.marker_sunlit_share = estimate->sunlit_share;
  }
  summary_.exposure_scale_source =
      exposure_filter_.empty() ? ExposureScaleSource::kGuess : ExposureScaleSource::kMarker;
  summary_.exposure_scale =
      exposure_filter_.empty() ? guessed_exposure_scale_ : exposure_filter_.ExposureScale();
  if (!exposure_filter_.empty()) summary_.exposure_scale_error = exposure_filter_.Error();
  summary_.exposure_scale_change = exposure_filter_.Change();
}

Result<void> SceneRenderer::UpdateCameraLook(ImageView<const std::uint8_t> rgb,
                                             const Transform<Camera, Marker>& camera_from_marker) {
  using compositor::CameraLook;
  if (!options_.match_look || frames_to_camera_look_-- > 0) return {};
  const auto seen = compositor::MeasureCameraLook(rgb, camera_, camera_from_marker,
                                                  marker_reflectance_, response_);
  if (!seen) return {};
  frames_to_camera_look_ = kLookStep - 1;
  recent_camera_looks_.push_back(*seen);
  if (recent_camera_looks_.size() > kLookWindow) recent_camera_looks_.pop_front();
  CameraLook look;
  const auto median = [&](const auto& value) {
    std::vector<double> values(recent_camera_looks_.size());
    std::transform(recent_camera_looks_.begin(), recent_camera_looks_.end(), values.begin(), value);
    return Median(std::move(values));
  };
  look.blur_px = median([](const CameraLook& l) { return l.blur_px; });
  for (int c = 0; c < 3; ++c) {
    look.noise_constant[c] = median([c](const CameraLook& l) { return l.noise_constant[c]; });
    look.noise_slope[c] = median([c](const CameraLook& l) { return l.noise_slope[c]; });
  }
  look.neighbour_correlation = median([](const CameraLook& l) { return l.neighbour_correlation; });
  look.channel_correlation = median([](const CameraLook& l) { return l.channel_correlation; });
  summary_.look = look;
  return composer_->SetCameraLook(look);
}

Result<RgbImage> SceneRenderer::Render(ImageView<const std::uint8_t> rgb,
                                       const Transform<Camera, Marker>& camera_from_marker,
                                       UtcTime time, const compositor::MarkerVisibility& cover) {
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
  PLEINAIR_RETURN_IF_ERROR(UpdateLight(time.PlusSeconds(later_s_)));
  times_.light_ms = MillisecondsSince(start);
  start = Clock::now();
  UpdateExposureScale(rgb, camera_from_marker);
  PLEINAIR_RETURN_IF_ERROR(UpdateCameraLook(rgb, camera_from_marker));
  times_.meter_ms = MillisecondsSince(start);
  start = Clock::now();
  PLEINAIR_ASSIGN_OR_RETURN(RgbImage composed,
                            composer_->Compose(rgb, camera_from_marker, summary_.exposure_scale));
  compositor::PutInFront(rgb, compositor::MaskOccluder(rgb, camera_, camera_from_marker, cover),
                         &composed);
  times_.compose_ms = MillisecondsSince(start);
  return composed;
}

}  // namespace pleinair::session
