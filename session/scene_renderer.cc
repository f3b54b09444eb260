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
// Where no marker could be read, the gain is guessed so that white paper on the ground shows as
// this display-linear value.
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
  renderer->skies_.source = compositor::StatedSky(scene);
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

void SceneRenderer::SetMarkerPrint(const scene::MarkerPrint& print) {
  print_ = print;
  if (composer_) composer_->SetMarkerBoard(print.board_size_m);
  if (!lit_ || light_from_outside_) return;
  meter_.emplace(print_, *solver_, lit_->daylight, scene::MarkerFromWorld(scene_.marker),
                 response_);
}

bool SceneRenderer::CanMeasureLight() const { return composer_ && !scene_.phantoms.empty(); }

void SceneRenderer::LookAtLight(ImageView<const std::uint8_t> rgb,
                                const Transform<Camera, Marker>& camera_from_marker, UtcTime time) {
  if (!look_) {
    look_ = std::make_unique<compositor::LightLook>(solver_, camera_, print_, scene_,
                                                    options_.overrides, time, response_);
  }
  look_->Add(rgb, camera_from_marker);
}

void SceneRenderer::SettleLight() {
  if (!look_) return;
  compositor::LightMemory of_no_other_look;
  const compositor::FoundLight found = look_->Settle(&of_no_other_look);
  look_.reset();
  summary_.measured = found.measured;
  scene_.marker.heading = found.heading;
  if (found.skies.source) skies_ = found.skies;
}

/// What the user says counts, for the first sun that is rendered.
void SceneRenderer::OverrideLight(const sky::SunPosition& sun) {
  compositor::MeasuredLight& light = summary_.measured;
  light.sun_to_sky_stated =
      compositor::SunToSky(*compositor::StatedSky(scene_)->ForSun(sun.ToSun(), sun.distance_au));
  if (options_.overrides.heading_deg) {
    light.heading_source = compositor::MeasuredLight::Source::kOverride;
  }
  const auto given = compositor::GivenSky(scene_, options_.overrides, sun);
  if (!given) return;
  light.sun_source = compositor::MeasuredLight::Source::kOverride;
  // What lies in the shade of trees was looked for under this sky.
  skies_.source = given->skies;
  skies_.scale = given->sky_scale;
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

LightOrder SceneRenderer::OrderLight(UtcTime time) const {
  return {time,    scene_.place_time, scene_.marker, skies_,
          solver_, coefficients_,     print_,        response_};
}

Result<void> SceneRenderer::TakeLight(std::shared_ptr<const SceneLight> light) {
  const compositor::ScaledDaylight& daylight = light->daylight;
  const Mat3& marker_from_world = light->marker_from_world;
  const LinearRgb sun = daylight.SunNormalIrradiance();
  const LinearRgb sky = daylight.SkyHorizontalIrradiance();
  summary_.sun_normal_lux = Luminance(sun);
  summary_.sky_horizontal_lux = Luminance(sky);
  summary_.measured.sun_to_sky = compositor::SunToSky(daylight);
  summary_.measured.sun_shines = Luminance(sun) > 0.0;
  const LinearRgb ground = sky + sun * std::max(0.0, light->sun.ToSun().xyz.z);
  const double white = scene_.marker.albedo_white / std::numbers::pi;
  guessed_gain_ = LinearRgb{kGuessedWhite, kGuessedWhite, kGuessedWhite} / (ground * white);
  composer_->LookForShade(light->order.skies.other_shade);
  PLEINAIR_RETURN_IF_ERROR(composer_->SetSunlight(light->order.skies.sunlight));
  PLEINAIR_RETURN_IF_ERROR(
      composer_->SetLight(light->meshes, daylight, marker_from_world, light->from_below));
  meter_ = light->meter;
  solver_ = light->order.solver;
  lit_ = std::move(light);
  MoveObjects();
  return {};
}

Result<void> SceneRenderer::PrepareLight(UtcTime time) {
  if (!composer_) return {};
  return UpdateLight(time.PlusSeconds(later_s_));
}

Result<void> SceneRenderer::UseLight(std::shared_ptr<const SceneLight> light) {
  if (!composer_) return {};
  if (!lit_) OverrideLight(light->sun);
  light_from_outside_ = true;
  skies_ = light->order.skies;
  if (!heading_is_edited_) scene_.marker.heading = light->order.marker.heading;
  return TakeLight(std::move(light));
}

Result<void> SceneRenderer::Edit(const SceneEdit& edit) {
  scene_ = WithEdit(scene_, edit);
  later_s_ = edit.later_s;
  heading_is_edited_ = edit.heading_deg.has_value();
  hold_gain_ = edit.hold_gain;
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
    return TakeLight(std::make_shared<const SceneLight>(OrderLight(time)));
  }
  const auto model = skies_.source->ForSun(summary_.sun.ToSun(), summary_.sun.distance_au);
  composer_->SetSun(compositor::ScaledDaylight(*model, skies_.scale, {1.0, 1.0, 1.0}),
                    scene::MarkerFromWorld(scene_.marker));
  return {};
}

void SceneRenderer::UpdateGain(ImageView<const std::uint8_t> rgb,
                               const Transform<Camera, Marker>& camera_from_marker) {
  using GainSource = LightSummary::GainSource;
  if (scene_.exposure_scale) {
    summary_.gain_source = GainSource::kScene;
    summary_.gain = *scene_.exposure_scale;
    return;
  }
  // Held once there is a reading to hold.
  if (hold_gain_ && !gains_.empty()) return;
  const auto reading = meter_ ? meter_->Measure(rgb, camera_, camera_from_marker) : std::nullopt;
  if (reading) {
    gains_.Add(reading->gain * skies_.print_shade, reading->error);
    ++summary_.readings;
    summary_.dappled_readings += reading->dappled ? 1 : 0;
    summary_.print_lit_share = reading->lit_share;
  }
  summary_.gain_source = gains_.empty() ? GainSource::kGuess : GainSource::kMarker;
  summary_.gain = gains_.empty() ? guessed_gain_ : gains_.Gain();
  if (!gains_.empty()) summary_.gain_error = gains_.Error();
  summary_.gain_change = gains_.Change();
}

Result<void> SceneRenderer::UpdateLook(ImageView<const std::uint8_t> rgb,
                                       const Transform<Camera, Marker>& camera_from_marker) {
  using compositor::PictureLook;
  if (!options_.match_look || frames_to_look_-- > 0) return {};
  const auto seen =
      compositor::MeasurePictureLook(rgb, camera_, camera_from_marker, print_, response_);
  if (!seen) return {};
  frames_to_look_ = kLookStep - 1;
  recent_looks_.push_back(*seen);
  if (recent_looks_.size() > kLookWindow) recent_looks_.pop_front();
  PictureLook look;
  const auto median = [&](const auto& value) {
    std::vector<double> values(recent_looks_.size());
    std::transform(recent_looks_.begin(), recent_looks_.end(), values.begin(), value);
    return Median(std::move(values));
  };
  look.blur_px = median([](const PictureLook& l) { return l.blur_px; });
  for (int c = 0; c < 3; ++c) {
    look.noise_constant[c] = median([c](const PictureLook& l) { return l.noise_constant[c]; });
    look.noise_slope[c] = median([c](const PictureLook& l) { return l.noise_slope[c]; });
  }
  look.neighbour_correlation = median([](const PictureLook& l) { return l.neighbour_correlation; });
  look.channel_correlation = median([](const PictureLook& l) { return l.channel_correlation; });
  summary_.look = look;
  return composer_->SetLook(look);
}

Result<RgbImage> SceneRenderer::Render(ImageView<const std::uint8_t> rgb,
                                       const Transform<Camera, Marker>& camera_from_marker,
                                       UtcTime time, const compositor::PrintCover& cover) {
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
  UpdateGain(rgb, camera_from_marker);
  PLEINAIR_RETURN_IF_ERROR(UpdateLook(rgb, camera_from_marker));
  times_.meter_ms = MillisecondsSince(start);
  start = Clock::now();
  PLEINAIR_ASSIGN_OR_RETURN(RgbImage composed,
                            composer_->Compose(rgb, camera_from_marker, summary_.gain));
  compositor::PutInFront(rgb, compositor::MaskOccluder(rgb, camera_, camera_from_marker, cover),
                         &composed);
  times_.compose_ms = MillisecondsSince(start);
  return composed;
}

}  // namespace pleinair::session
