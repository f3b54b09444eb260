#include "session/scene_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <memory>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include "compositor/light/light_solver.h"
#include "compositor/light/scaled_sky.h"
#include "compositor/photometry/sky_fit.h"
#include "compositor/surfaces/polygon_model.h"
#include "devices/calibration/response_file.h"
#include "scene/marker_heading.h"
#include "scene/marker_reflectance.h"
#include "scene/sun_over_place.h"
#include "session/leaf_materials.h"
#include "session/scene_animation.h"

namespace pleinair::session {
namespace {

// Without an exposure estimate, white paper on the ground is assumed to have this display-linear
// value.
constexpr double kGuessedWhite = 0.8;

using Clock = std::chrono::steady_clock;

double MillisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

SceneRenderer::SceneRenderer(const CameraModel& camera, const scene::SceneDescription& scene)
    : camera_{camera, {}}, scene_(scene) {}

SceneRenderer::~SceneRenderer() = default;

Result<std::unique_ptr<SceneRenderer>> SceneRenderer::Create(
    const CameraModel& camera, const scene::SceneDescription& scene,
    const compositor::ComposerOptions& options, const LightOptions& light) {
  std::unique_ptr<SceneRenderer> renderer(new SceneRenderer(camera, scene));
  if (light.match_look) renderer->matched_.look.emplace();
  PLEINAIR_ASSIGN_OR_RETURN(renderer->matched_.lens,
                            FrameLens::Create(scene, light.defocus, light.match_look));
  PLEINAIR_ASSIGN_OR_RETURN(renderer->matched_.exposure,
                            FrameExposure::Create(scene, light.motion_blur, light.match_look));
  renderer->matched_.max_views = light.motion_blur.max_views;
  renderer->summary_.camera.lens_places = light.defocus.places;
  renderer->summary_.camera.defocus = renderer->matched_.lens.source();
  renderer->edited_.first_places = UneditedScene(scene, options, 0.0).objects;
  std::vector<compositor::PlacedModel>& placed = renderer->placed_;
  for (const scene::ModelReference& phantom : scene.phantoms) {
    PLEINAIR_ASSIGN_OR_RETURN(auto model, PlaceModel(phantom, true, scene.marker));
    placed.push_back(std::move(model));
  }
  for (const scene::ModelReference& object : scene.objects) {
    PLEINAIR_ASSIGN_OR_RETURN(auto model, PlaceModel(object, false, scene.marker));
    placed.push_back(std::move(model));
  }
  PLEINAIR_RETURN_IF_ERROR(ReplaceByLeaves(scene.leaves, scene.place_time.start, &placed));
  if (!scene.DrawsAnything()) return renderer;
  compositor::ComposerOptions composing = options;
  if (!scene.camera.response.empty()) {
    renderer->summary_.response.source = ResponseSummary::Source::kStated;
  } else if (light.film_response && !light.film_response->IsSrgb()) {
    renderer->summary_.response.source = ResponseSummary::Source::kFilm;
    composing.response = *light.film_response;
    renderer->camera_.response = composing.response;
  }
  if (!scene.camera.response.empty() && scene.camera.response != kSrgbResponse) {
    PLEINAIR_ASSIGN_OR_RETURN(composing.response,
                              devices::ReadCameraResponse(scene.camera.response));
    renderer->camera_.response = composing.response;
  }
  const compositor::LightSolverOptions solving = SolverOptionsOf(light);
  // The solver prepares the geometry while OpenGL compiles its programs.
  auto solver = std::async(std::launch::async,
                           [&] { return compositor::LightSolver::Create(placed, solving); });
  PLEINAIR_ASSIGN_OR_RETURN(renderer->composer_,
                            compositor::Composer::Create(camera, placed, composing));
  PLEINAIR_ASSIGN_OR_RETURN(auto prepared, solver.get());
  renderer->light_.emplace(std::move(prepared), scene, light);
  return renderer;
}

void SceneRenderer::SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance) {
  marker_reflectance_ = marker_reflectance;
  if (composer_) composer_->SetMarkerMargin(marker_reflectance.board_size_m);
  if (!light_ || !light_->in_use() || light_->made_elsewhere()) return;
  exposure_.SetMeter(compositor::MarkerLightMeter(
      marker_reflectance_, light_->phantoms(), light_->in_use()->daylight,
      scene::MarkerFromWorld(scene_.marker), camera_.response));
}

bool SceneRenderer::CanMeasureLight() const { return composer_ && !scene_.phantoms.empty(); }

void SceneRenderer::ObserveLight(CameraImageView image,
                                 const Transform<Camera, Marker>& camera_from_marker, UtcTime time,
                                 bool shows_marker) {
  light_->Observe(image, camera_.model, camera_from_marker, time, scene_, marker_reflectance_,
                  camera_.response, shows_marker);
}

void SceneRenderer::ProbeLight(CameraImageView image, const CameraModel& camera,
                               const Transform<Camera, Marker>& camera_from_marker,
                               std::int64_t frame_index, std::int64_t timestamp_ns,
                               const scene::MarkerReflectance& marker_reflectance) {
  if (!light_) return;
  light_->Probe(image, camera, camera_from_marker, frame_index, timestamp_ns, marker_reflectance,
                camera_.response);
}

void SceneRenderer::FollowLight(UtcTime time, const std::set<std::int64_t>& reference) {
  if (light_) light_->Follow(scene_, time, reference);
}

Result<void> SceneRenderer::EstimateResponse(const std::set<std::int64_t>& frames) {
  using Source = ResponseSummary::Source;
  if (!light_ || summary_.response.source == Source::kStated) return {};
  const auto found = light_->EstimateResponse(frames);
  if (!found || !found->usable) return {};
  summary_.response = {found->conclusive ? Source::kMeasured : summary_.response.source,
                       found->log_evidence, found->log_error};
  if (!found->conclusive) return {};
  camera_.response = found->response;
  return composer_->SetResponse(camera_.response);
}

Result<void> SceneRenderer::EstimateLight() {
  if (!light_) return {};
  const auto found = light_->Conclude(UncoloredSurfaces(scene_.phantoms));
  if (!found) return {};
  summary_.measured = found->light.measured;
  scene_.marker.heading = found->light.heading;
  return UseColors(found->colors);
}

/// Gives described surfaces their measured colors. Light is traced anew.
Result<void> SceneRenderer::UseColors(const std::map<int, compositor::SurfaceColor>& colors) {
  bool is_new = false;
  for (const auto& [index, color] : colors) {
    const auto i = static_cast<std::size_t>(index);
    scene::DescribedSurface& surface = *scene_.phantoms[i].surface;
    if (color.outcome == compositor::SurfaceColor::Outcome::kMeasured) {
      surface.reflectance = color.reflectance;
      placed_[i].model = std::make_shared<const compositor::Model>(
          compositor::PolygonModel(surface.name, surface.polygons, surface.reflectance));
      is_new = true;
    }
    summary_.surface_colors.push_back({surface.name, surface.reflectance, color});
  }
  return is_new ? light_->UseModels(placed_) : Result<void>();
}

std::shared_ptr<const compositor::DaylightCoefficients> SceneRenderer::Coefficients(
    const compositor::CoefficientProgress& progress) {
  return light_->Coefficients(scene_.marker, progress);
}

LightingRequest SceneRenderer::MakeLightingRequest(UtcTime time) const {
  return light_->Request(time, scene_, marker_reflectance_, camera_.response);
}

Result<void> SceneRenderer::TakeLight(std::shared_ptr<const BakedLighting> light,
                                      bool made_elsewhere) {
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
  exposure_.SetGuess(LinearRgb{kGuessedWhite, kGuessedWhite, kGuessedWhite} / (ground * white));
  composer_->AssumeUnmodelledShadows(light->request.skies.unmodelled_shadows);
  PLEINAIR_RETURN_IF_ERROR(
      composer_->SetSunTransmittance({.trees = light->request.skies.sun_transmittance}));
  PLEINAIR_RETURN_IF_ERROR(composer_->SetLight(light->meshes,
                                               light->mirrored ? *light->mirrored : daylight,
                                               marker_from_world, light->from_below));
  exposure_.SetMeter(light->meter);
  // Beside bodies that change their shape, the composer has its own indirect illumination.
  const bool fades = std::ranges::none_of(
      placed_, [](const auto& placed) { return placed.playback.animation != nullptr; });
  light_->Use(std::move(light), made_elsewhere, fades);
  MoveObjects();
  return {};
}

Result<void> SceneRenderer::PrepareLight(UtcTime time) {
  if (!composer_) return {};
  return UpdateLight(time.PlusSeconds(edited_.later_s));
}

Result<void> SceneRenderer::UseLight(std::shared_ptr<const BakedLighting> light) {
  if (!composer_) return {};
  if (!light_->in_use()) light_->Override(scene_, light->sun, &summary_.measured);
  if (!edited_.heading) scene_.marker.heading = light->request.marker.heading;
  return TakeLight(std::move(light), true);
}

/// Draws the light between the last one and the one in use, while one fades into the other.
Result<void> SceneRenderer::FadeLight(UtcTime time) {
  const std::vector<compositor::LitMesh>* meshes = light_->FadedMeshes(time);
  return meshes != nullptr ? composer_->SetAmbient(*meshes) : Result<void>();
}

Result<void> SceneRenderer::Edit(const SceneEdit& edit) {
  scene_ = WithEdit(scene_, edit);
  edited_.later_s = edit.later_s;
  edited_.heading = edit.heading_deg.has_value();
  exposure_.SetLocked(edit.lock_exposure);
  if (!composer_) return {};
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    MoveTo(edit.objects[i], &placed_[scene_.phantoms.size() + i]);
  }
  MoveObjects();
  compositor::ComposerOptions drawing = edit.drawing;
  drawing.response = camera_.response;
  return composer_->SetOptions(drawing);
}

void SceneRenderer::LetGo() {
  if (composer_) composer_->LetGo();
}

/// Draws the objects at their current placement, with the light of their baked placement.
void SceneRenderer::MoveObjects() {
  const BakedLighting* lit = light_->in_use();
  if (lit == nullptr || lit->objects.empty()) return;
  for (std::size_t i = 0; i < lit->objects.size(); ++i) {
    const std::size_t model = scene_.phantoms.size() + i;
    // Bodies that change their shape have no part in the baked light, and stay where they began.
    const ObjectPlace& place =
        placed_[model].playback.animation ? edited_.first_places[i] : lit->objects[i];
    // Inverse of a rotation times a scale.
    Mat3 back = LinearOf(place).Transposed();
    for (double& element : back.m) element /= place.scale * place.scale;
    const Mat3 moved = placed_[model].linear * back;
    composer_->MoveModel(static_cast<int>(model), moved,
                         scene_.objects[i].translation_m - moved * place.translation_m);
  }
}

Result<void> SceneRenderer::UpdateLight(UtcTime time) {
  summary_.sun = scene::SunOver(scene_.place_time, time);
  if (!light_->in_use()) light_->Override(scene_, summary_.sun, &summary_.measured);
  if (light_->IsStale(summary_.sun)) {
    if (light_->has_cache()) Coefficients({});
    return TakeLight(std::make_shared<const BakedLighting>(MakeLightingRequest(time)), false);
  }
  const compositor::SkyState& skies = light_->skies();
  const auto model = skies.source->ForSun(summary_.sun.ToSun(), summary_.sun.distance_au);
  composer_->SetSun(compositor::ScaledSky(*model, skies.scale, {1.0, 1.0, 1.0}),
                    scene::MarkerFromWorld(scene_.marker));
  return {};
}

void SceneRenderer::UpdateExposureScale(CameraImageView image,
                                        const std::optional<Transform<Camera, Marker>>& marker,
                                        const FollowedLight& followed) {
  if (scene_.camera.exposure_scale) {
    summary_.exposure_scale_source = LightSummary::ExposureScaleSource::kScene;
    summary_.exposure_scale = *scene_.camera.exposure_scale * followed.exposure;
    return;
  }
  exposure_.Read(image, camera_.model, marker, light_->skies().marker_shade, followed, &summary_);
}

void SceneRenderer::SummarizeLight(const FollowedLight& followed) {
  const BakedLighting& baked = *light_->in_use();
  const LinearRgb white = summary_.exposure_scale * std::numbers::inv_pi;
  const double sine_sun = std::max(0.0, baked.sun.ToSun().xyz.z);
  summary_.frame.followed = followed;
  summary_.frame.sun_on_white =
      baked.daylight.SunNormalIrradiance() * sine_sun * followed.mix.sun * white;
  summary_.frame.sky_on_white = baked.daylight.SkyHorizontalIrradiance() * followed.mix.sky * white;
  if (followed.source != compositor::FrameLight::Source::kStated) return;
  // The baked light has the sun above the clouds.
  const double sun = Luminance(summary_.frame.sun_on_white);
  const double sky = Luminance(summary_.frame.sky_on_white);
  summary_.sun_normal_lux = Luminance(baked.daylight.SunNormalIrradiance() * followed.mix.sun);
  summary_.sky_horizontal_lux =
      Luminance(baked.daylight.SkyHorizontalIrradiance() * followed.mix.sky);
  summary_.measured.sun_to_sky = sky > 0.0 ? sun / sky : 0.0;
}

void SceneRenderer::UseMeasuredLens(const compositor::FocusFit& fit,
                                    const std::vector<FrameTime>& frames) {
  matched_.lens.UseMeasured(fit, frames);
  summary_.camera.defocus = matched_.lens.source();
}

void SceneRenderer::UseLensOf(std::int64_t frame_index) {
  summary_.camera.lens = matched_.lens.Of(frame_index);
  if (composer_) composer_->SetLens(summary_.camera.lens, summary_.camera.lens_places);
}

void SceneRenderer::UseMotion(std::int64_t frame_index, const PoseMotion& motion,
                              const std::optional<double>& own_exposure_s) {
  summary_.camera.exposure = matched_.exposure.Of(frame_index, own_exposure_s);
  matched_.motion = {};
  const double exposure_s = summary_.camera.exposure.seconds;
  if (motion && exposure_s > 0.0) {
    matched_.motion = [motion, exposure_s](double share) { return motion(share * exposure_s); };
  }
  if (composer_) composer_->SetMotion(matched_.motion, matched_.max_views);
}

Result<void> SceneRenderer::UpdateCameraLook(CameraImageView image,
                                             const Transform<Camera, Marker>& camera_from_marker) {
  if (!matched_.look) return {};
  const auto look =
      matched_.look->Update(image.rgb(), camera_.model, camera_from_marker, marker_reflectance_,
                            camera_.response, summary_.camera.lens, matched_.motion);
  if (!look) return {};
  summary_.camera.look = look;
  return composer_->SetCameraLook(look);
}

Result<void> SceneRenderer::Follow(CameraImageView image,
                                   const Transform<Camera, Marker>& camera_from_marker,
                                   UtcTime time, FollowedLight followed, bool shows_marker) {
  times_ = {};
  if (!composer_) return {};
  auto start = Clock::now();
  const UtcTime lit_at = time.PlusSeconds(edited_.later_s);
  PLEINAIR_RETURN_IF_ERROR(UpdateLight(lit_at));
  if (auto stated = light_->StatedAt(lit_at, summary_.sun)) {
    followed = stated->followed;
    PLEINAIR_RETURN_IF_ERROR(composer_->SetSunTransmittance({.clouds = stated->shadow}));
  }
  PLEINAIR_RETURN_IF_ERROR(composer_->SetLightMix(light_->in_use()->meshes, followed.mix));
  PLEINAIR_RETURN_IF_ERROR(ink_.Update(std::span(placed_).first(scene_.phantoms.size()),
                                       scene_.marker, composer_.get()));
  // Last: it draws other meshes, with the same mix.
  PLEINAIR_RETURN_IF_ERROR(FadeLight(time));
  times_.light_ms = MillisecondsSince(start);
  start = Clock::now();
  // At the time of the frame, whatever hour an edit lights the scene with.
  PlayAnimations(placed_, scene_.place_time.start, time, composer_.get());
  times_.animation_ms = MillisecondsSince(start);
  start = Clock::now();
  std::optional<Transform<Camera, Marker>> marker;
  if (shows_marker) marker = camera_from_marker;
  UpdateExposureScale(image, marker, followed);
  if (marker) PLEINAIR_RETURN_IF_ERROR(UpdateCameraLook(image, *marker));
  SummarizeLight(followed);
  times_.meter_ms = MillisecondsSince(start);
  return {};
}

Result<void> SceneRenderer::Advance(CameraImageView image,
                                    const Transform<Camera, Marker>& camera_from_marker,
                                    UtcTime time, const FollowedLight& followed,
                                    bool shows_marker) {
  PLEINAIR_RETURN_IF_ERROR(Follow(image, camera_from_marker, time, followed, shows_marker));
  return composer_ ? composer_->SkipImage(camera_from_marker) : Result<void>();
}

Result<RgbImage> SceneRenderer::Render(CameraImageView image,
                                       const Transform<Camera, Marker>& camera_from_marker,
                                       UtcTime time, const compositor::MarkerVisibility& cover,
                                       const FollowedLight& followed, bool shows_marker) {
  PLEINAIR_RETURN_IF_ERROR(Follow(image, camera_from_marker, time, followed, shows_marker));
  if (!composer_) return CopyImage(image.rgb());
  const auto start = Clock::now();
  PLEINAIR_ASSIGN_OR_RETURN(RgbImage composed,
                            composer_->Compose(image, camera_from_marker, summary_.exposure_scale));
  summary_.camera.mixed_pixels = composer_->MixedPixels();
  const compositor::LensFigures drawn = composer_->DrawnLens();
  compositor::LensFigures& most = summary_.camera.drawn_lens;
  most.largest_circle_px = std::max(most.largest_circle_px, drawn.largest_circle_px);
  most.layers = std::max(most.layers, drawn.layers);
  most.peels = std::max(most.peels, drawn.peels);
  most.longest_streak_px = std::max(most.longest_streak_px, drawn.longest_streak_px);
  most.views = std::max(most.views, drawn.views);
  compositor::PutInFront(
      image.rgb(), compositor::MaskOccluder(image.rgb(), camera_.model, camera_from_marker, cover),
      &composed);
  times_.compose_ms = MillisecondsSince(start);
  return composed;
}

}  // namespace pleinair::session
