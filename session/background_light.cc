#include "session/background_light.h"

#include <chrono>
#include <utility>

#include "compositor/photometry/sky_state.h"
#include "scene/marker_heading.h"
#include "scene/sun_over_place.h"
#include "session/following/low_priority.h"
#include "session/scene_light.h"
#include "session/scene_renderer.h"

namespace pleinair::session {
namespace {

// Number of frames per light estimate and their minimum interval, as in replay. A new estimate
// follows after a while, because clouds pass.
constexpr int kLightFrames = 8;
constexpr double kBetweenEstimates_s = 0.3, kBetweenMeasurements_s = 60.0;
// Rays of the lights that are in use until the daylight coefficients are ready.
constexpr int kFewRays = 48;
// Rays of the draft, which is in use for about a second (docs/measurements/live.md).
constexpr int kDraftRays = 8;
constexpr std::chrono::milliseconds kLookAround{100};

}  // namespace

bool BackgroundLight::Wanted::operator==(const Wanted& other) const {
  return edit.sky == other.edit.sky && edit.heading_deg == other.edit.heading_deg &&
         edit.objects == other.edit.objects && edit.phantoms == other.edit.phantoms &&
         marker_reflectance == other.marker_reflectance;
}

BackgroundLight::BackgroundLight(Setup setup)
    : setup_(std::move(setup)),
      known_{.heading = setup_.scene.marker.heading},
      shared_{.wanted = {setup_.edit, setup_.time, setup_.marker_reflectance},
              .next_estimate = setup_.time} {
  UseOverriddenSky(setup_.time, &setup_.skies);
  known_.clouds = clouds::MakeFields(setup_.scene.clouds.layers);
}

Result<std::unique_ptr<BackgroundLight>> BackgroundLight::Create(Setup setup) {
  std::unique_ptr<BackgroundLight> light(new BackgroundLight(std::move(setup)));
  PLEINAIR_RETURN_IF_ERROR(light->Place(light->setup_.edit, false));
  light->Make(light->shared_.wanted, light->placed_.solver->WithRays(kDraftRays));
  light->made_.wanted.reset();  // A better one is wanted.
  light->thread_ = std::thread([self = light.get()] { self->Run(); });
  return light;
}

BackgroundLight::~BackgroundLight() { Stop(); }

void BackgroundLight::Stop() {
  {
    const std::lock_guard lock(mutex_);
    shared_.stop = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void BackgroundLight::SetEdit(const SceneEdit& edit) {
  const std::lock_guard lock(mutex_);
  shared_.wanted.edit = edit;
  changed_.notify_all();
}

void BackgroundLight::SetTime(UtcTime time) {
  const std::lock_guard lock(mutex_);
  shared_.wanted.time = time;
}

void BackgroundLight::SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance) {
  const std::lock_guard lock(mutex_);
  shared_.wanted.marker_reflectance = marker_reflectance;
  changed_.notify_all();
}

void BackgroundLight::Show(std::shared_ptr<const devices::Frame> frame,
                           const Transform<Camera, Marker>& camera_from_marker, UtcTime time) {
  const std::lock_guard lock(mutex_);
  if (time < shared_.next_estimate) return;
  shared_.next_estimate = time.PlusSeconds(kBetweenEstimates_s);
  shared_.shown = Shown{std::move(frame), camera_from_marker, time};
  changed_.notify_all();
}

std::shared_ptr<const BakedLighting> BackgroundLight::Take() {
  const std::lock_guard lock(mutex_);
  return std::move(shared_.newest);
}

BackgroundLight::Progress BackgroundLight::progress() const {
  const std::lock_guard lock(mutex_);
  return shared_.progress;
}

void BackgroundLight::Run() {
  LowerPriority();
  compositor::CoefficientWorker worker;  // Here, so that its threads inherit the low priority.
  while (true) {
    Wanted wanted;
    std::optional<Shown> shown;
    {
      std::unique_lock lock(mutex_);
      if (!shared_.stop) changed_.wait_for(lock, kLookAround);
      if (shared_.stop) break;
      wanted = shared_.wanted;
      shown = std::exchange(shared_.shown, std::nullopt);
    }
    TakeCoefficients(worker);
    PlaceIfPossible(&wanted);
    if (NeedsLight(wanted) && !IsSuperseded(wanted)) Make(wanted, placed_.solver);
    if (shown) EstimateLight(*shown, wanted);
    if (placed_.ordered_for != placed_.solver || wanted.edit.convergence != placed_.convergence) {
      WantCoefficients(wanted, &worker);
    }
  }
}

/// Follows the placements of an edit. Those that cannot be lit are replaced in the edit by the last
/// ones that could. Moved surfaces get a draft, so that they follow the mouse: with the next light
/// they hide objects where they now are.
void BackgroundLight::PlaceIfPossible(Wanted* wanted) {
  SceneEdit& edit = wanted->edit;
  const bool moves_surfaces = edit.phantoms != placed_.phantoms;
  if (edit.objects == placed_.objects && !moves_surfaces) return;
  const bool refused = placed_.refused && edit.objects == placed_.refused->objects &&
                       edit.phantoms == placed_.refused->phantoms;
  if (!refused && Place(edit, moves_surfaces)) {
    if (moves_surfaces) Make(*wanted, placed_.solver->WithRays(kDraftRays));
    made_.wanted.reset();  // A better one is wanted.
    return;
  }
  if (!refused) placed_.refused = edit;
  edit.objects = placed_.objects;
  edit.phantoms = placed_.phantoms;
}

/// Builds a solver for the placements of an edit. After an error all is as before.
/// `replaces_surfaces`: the described surfaces moved, or have other colors.
Result<void> BackgroundLight::Place(const SceneEdit& edit, bool replaces_surfaces) {
  std::vector<compositor::PlacedModel> placed = setup_.placed;
  const std::size_t phantoms = placed.size() - edit.objects.size();
  for (std::size_t i = 0; i < edit.objects.size(); ++i) {
    MoveTo(edit.objects[i], &placed[phantoms + i]);
  }
  if (replaces_surfaces) {
    const scene::SceneDescription scene = WithEdit(setup_.scene, edit);
    for (std::size_t i = 0; i < phantoms; ++i) {
      if (!scene.phantoms[i].surface) continue;
      PLEINAIR_ASSIGN_OR_RETURN(placed[i], PlaceModel(scene.phantoms[i], true, scene.marker));
    }
  }
  if (const auto solver = std::exchange(setup_.solver, nullptr)) {
    placed_.solver = solver->WithRays(kFewRays);
  } else {
    compositor::LightSolverOptions options;
    options.rays_per_vertex = kFewRays;
    options.max_patches = setup_.light.overrides.max_patches.value_or(options.max_patches);
    PLEINAIR_ASSIGN_OR_RETURN(placed_.solver, compositor::LightSolver::Create(placed, options));
  }
  setup_.placed = std::move(placed);
  if (replaces_surfaces) known_.estimator.reset();  // It has seen shadows of other phantoms.
  placed_.objects = edit.objects;
  placed_.phantoms = edit.phantoms;
  placed_.refused.reset();
  placed_.coefficients.reset();  // They belong to another scene.
  made_.wanted.reset();
  return {};
}

/// True if the surfaces have moved again meanwhile: their draft comes first.
bool BackgroundLight::IsSuperseded(const Wanted& wanted) const {
  const std::lock_guard lock(mutex_);
  return shared_.wanted.edit.phantoms != wanted.edit.phantoms &&
         !(placed_.refused && shared_.wanted.edit.phantoms == placed_.refused->phantoms);
}

bool BackgroundLight::NeedsLight(const Wanted& wanted) const {
  if (!made_.wanted || !(*made_.wanted == wanted)) return true;
  const sky::SunPosition sun = scene::SunOver(WithEdit(setup_.scene, wanted.edit).place_time,
                                              wanted.time.PlusSeconds(wanted.edit.later_s));
  return !IsNearSun(made_.sun, sun);
}

/// Applies the user's sky overrides, if any, for the sun at this time.
void BackgroundLight::UseOverriddenSky(UtcTime time, compositor::SkyState* skies) const {
  const auto given = compositor::OverriddenSky(setup_.scene, setup_.light.overrides,
                                               scene::SunOver(setup_.scene.place_time, time));
  if (!given) return;
  skies->source = given->skies;
  skies->scale = given->sky_radiance_scale;
}

LightingRequest BackgroundLight::LightingRequestFor(
    const Wanted& wanted, std::shared_ptr<const compositor::LightSolver> solver) {
  scene::SceneDescription scene = setup_.scene;
  scene.marker.heading = known_.heading;
  scene = WithEdit(scene, wanted.edit);
  if (!wanted.edit.sky) {
    known_.skies = known_.found.source ? known_.found : setup_.skies;
    known_.skies_of.reset();
  } else if (wanted.edit.sky != known_.skies_of) {
    sky::SkyConditions conditions;
    conditions.turbidity = wanted.edit.sky->turbidity;
    conditions.cloud_cover = wanted.edit.sky->cloud_cover;
    auto source = sky::SkySource::Create({sky::SkyModelKind::kAtmosphere, 0}, conditions);
    // Outside the range of the sky model, the last sky stays.
    if (source) known_.skies = {*std::move(source), {1.0, 1.0, 1.0}};
    known_.skies_of = wanted.edit.sky;
  }
  // Tree shade does not depend on the air. With a given heading there is no new estimate
  // (MayEstimate), and shade under that heading is unknown.
  if (wanted.edit.sky)
    known_.skies.unmodelled_shadows = wanted.edit.heading_deg || known_.found.unmodelled_shadows;
  return {wanted.time.PlusSeconds(wanted.edit.later_s),
          scene.place_time,
          scene.marker,
          known_.skies,
          std::move(solver),
          placed_.coefficients,
          wanted.marker_reflectance,
          setup_.response,
          known_.clouds,
          setup_.light.changes == LightChangeMode::kStated};
}

void BackgroundLight::Make(const Wanted& wanted,
                           std::shared_ptr<const compositor::LightSolver> solver) {
  auto light = std::make_shared<BakedLighting>(LightingRequestFor(wanted, std::move(solver)));
  light->objects = placed_.objects;
  light->phantoms = placed_.phantoms;
  made_.wanted = wanted;
  made_.sun = light->sun;
  const std::lock_guard lock(mutex_);
  shared_.progress.heading_deg = ToDegrees(light->request.marker.heading);
  shared_.newest = std::move(light);
}

/// True if frames show the light in which the scene is drawn, not that of another time or location.
bool BackgroundLight::MayEstimate(const Wanted& wanted) const {
  return !setup_.scene.phantoms.empty() && wanted.marker_reflectance.size_m > 0.0 &&
         !(wanted.edit.sky && wanted.edit.heading_deg) && wanted.edit.later_s == 0.0 &&
         wanted.edit.latitude_deg == setup_.scene.place_time.latitude_deg &&
         wanted.edit.longitude_deg == setup_.scene.place_time.longitude_deg;
}

void BackgroundLight::EstimateLight(const Shown& shown, const Wanted& wanted) {
  if (!MayEstimate(wanted)) {
    known_.estimator.reset();
    const std::lock_guard lock(mutex_);
    shared_.progress.frames_in_estimate = 0;
    return;
  }
  if (!known_.estimator) {
    known_.estimator = std::make_unique<compositor::LightEstimator>(
        std::shared_ptr<const compositor::PhantomRays>(placed_.solver, &placed_.solver->phantoms()),
        setup_.camera, wanted.marker_reflectance, setup_.scene, setup_.light.overrides, shown.time,
        setup_.response);
  }
  known_.estimator->Add(devices::ImageOf(*shown.frame), shown.camera_from_marker);
  {
    const std::lock_guard lock(mutex_);
    shared_.progress.frames_in_estimate = known_.estimator->frames();
  }
  if (known_.estimator->frames() < kLightFrames) return;
  const compositor::LightEstimate found = known_.estimator->Estimate(&known_.filter);
  const auto colors =
      known_.estimator->MeasureColors(found, UncoloredSurfaces(setup_.scene.phantoms));
  known_.estimator.reset();
  // The frames may show any part of the stated clouds' light.
  if (setup_.light.changes != LightChangeMode::kStated) known_.found = found.skies;
  if (known_.found.source) UseOverriddenSky(shown.time, &known_.found);
  known_.heading = found.heading;
  made_.wanted.reset();
  UseColors(colors);
  const std::lock_guard lock(mutex_);
  shared_.progress.measured = found.measured;
  shared_.progress.frames_in_estimate = 0;
  shared_.next_estimate = shown.time.PlusSeconds(kBetweenMeasurements_s);
  shared_.shown.reset();  // It arrived meanwhile, and would start the next estimate too early.
}

/// Gives described surfaces their measured colors. Where such a scene cannot be lit, the last
/// stays.
void BackgroundLight::UseColors(const std::map<int, compositor::SurfaceColor>& colors) {
  const std::vector<scene::ModelReference> before = setup_.scene.phantoms;
  bool is_new = false;
  for (const auto& [index, color] : colors) {
    if (color.outcome != compositor::SurfaceColor::Outcome::kMeasured) continue;
    scene::DescribedSurface& surface =
        *setup_.scene.phantoms[static_cast<std::size_t>(index)].surface;
    surface.reflectance = color.reflectance;
    surface.has_color = true;
    is_new = true;
  }
  if (!is_new) return;
  SceneEdit edit = setup_.edit;
  edit.objects = placed_.objects;
  edit.phantoms = placed_.phantoms;
  if (!Place(edit, true)) {
    setup_.scene.phantoms = before;  // The next estimate measures them again.
    return;
  }
  placed_.has_measured_colors = true;
}

void BackgroundLight::WantCoefficients(const Wanted& wanted,
                                       compositor::CoefficientWorker* worker) {
  placed_.ordered_for = placed_.solver;
  placed_.convergence = wanted.edit.convergence;
  compositor::CoefficientOptions options;
  options.convergence = placed_.convergence;
  options.division = setup_.light.sky_division;
  // Trial edits would fill the disk: each object placement has its own file. So would measured
  // colors, which are never quite those of another session.
  const bool as_begun = !placed_.has_measured_colors &&
                        wanted.edit.objects == setup_.edit.objects &&
                        wanted.edit.phantoms == setup_.edit.phantoms &&
                        wanted.edit.convergence == setup_.edit.convergence;
  if (as_begun) options.cache = setup_.light.cache;
  worker->Want(placed_.solver, scene::MarkerFromWorld(setup_.scene.marker) * Vec3{0.0, 0.0, 1.0},
               options);
}

/// Uses new coefficients, if there are any for the current scene.
void BackgroundLight::TakeCoefficients(const compositor::CoefficientWorker& worker) {
  const auto newest = worker.Newest();
  {
    const std::lock_guard lock(mutex_);
    shared_.progress.coefficients = placed_.ordered_for ? worker.progress() : 0.0;
  }
  if (!newest || newest->solver != placed_.solver || newest->coefficients == placed_.coefficients)
    return;
  placed_.coefficients = newest->coefficients;
  made_.wanted.reset();
  if (placed_.coefficients->kept) return;
  const std::lock_guard lock(mutex_);
  shared_.progress.failed_to_keep = true;
}

}  // namespace pleinair::session
