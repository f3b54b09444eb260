#include "session/background_light.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <utility>

#include "compositor/photometry/sky_state.h"
#include "scene/marker_heading.h"
#include "scene/sun_over_place.h"

namespace pleinair::session {
namespace {

// The light is read from so many frames, at least so far apart, as replay does; and again after a
// while, since clouds pass.
constexpr int kLightFrames = 8;
constexpr double kBetweenEstimates_s = 0.3, kBetweenMeasurements_s = 60.0;
// Of lights that stand until the daylight coefficients are there.
constexpr int kFewRays = 48;
constexpr std::chrono::milliseconds kLookAround{100};
// Below everything that a frame waits for.
constexpr int kNice = 10;

void LowerPriority() {
  // Of this thread, and of those that it starts: Linux counts niceness by thread. Where it is
  // refused, nothing is lost but time.
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNice));
}

}  // namespace

bool BackgroundLight::Wanted::operator==(const Wanted& other) const {
  return edit.sky == other.edit.sky && edit.heading_deg == other.edit.heading_deg &&
         edit.objects == other.edit.objects && marker_reflectance == other.marker_reflectance;
}

BackgroundLight::BackgroundLight(Setup setup)
    : setup_(std::move(setup)),
      heading_(setup_.scene.marker.heading),
      wanted_{setup_.edit, setup_.time, {}},
      next_estimate_(setup_.time) {
  UseOverriddenSky(setup_.time, &setup_.skies);
}

Result<std::unique_ptr<BackgroundLight>> BackgroundLight::Create(Setup setup) {
  std::unique_ptr<BackgroundLight> light(new BackgroundLight(std::move(setup)));
  PLEINAIR_RETURN_IF_ERROR(light->Place(light->setup_.edit.objects));
  light->Make(light->wanted_);
  light->thread_ = std::thread([self = light.get()] { self->Run(); });
  return light;
}

BackgroundLight::~BackgroundLight() { Stop(); }

void BackgroundLight::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void BackgroundLight::SetEdit(const SceneEdit& edit) {
  const std::lock_guard lock(mutex_);
  wanted_.edit = edit;
  changed_.notify_all();
}

void BackgroundLight::SetTime(UtcTime time) {
  const std::lock_guard lock(mutex_);
  wanted_.time = time;
}

void BackgroundLight::SetMarkerReflectance(const scene::MarkerReflectance& marker_reflectance) {
  const std::lock_guard lock(mutex_);
  wanted_.marker_reflectance = marker_reflectance;
  changed_.notify_all();
}

void BackgroundLight::Show(std::shared_ptr<const devices::Frame> frame,
                           const Transform<Camera, Marker>& camera_from_marker, UtcTime time) {
  const std::lock_guard lock(mutex_);
  if (time < next_estimate_) return;
  next_estimate_ = time.PlusSeconds(kBetweenEstimates_s);
  shown_ = Shown{std::move(frame), camera_from_marker, time};
  changed_.notify_all();
}

std::shared_ptr<const BakedLighting> BackgroundLight::Take() {
  const std::lock_guard lock(mutex_);
  return std::move(newest_);
}

BackgroundLight::Progress BackgroundLight::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

void BackgroundLight::Run() {
  LowerPriority();
  compositor::CoefficientWorker worker;  // Here, because its threads are as patient as this one.
  while (true) {
    Wanted wanted;
    std::optional<Shown> shown;
    {
      std::unique_lock lock(mutex_);
      if (!stop_) changed_.wait_for(lock, kLookAround);
      if (stop_) break;
      wanted = wanted_;
      shown = std::exchange(shown_, std::nullopt);
    }
    TakeCoefficients(worker);
    if (wanted.edit.objects != placed_objects_) {
      // What cannot be placed stays where it was, and lit as it was.
      if (!Place(wanted.edit.objects)) wanted.edit.objects = placed_objects_;
    }
    if (NeedsLight(wanted)) Make(wanted);
    if (shown) EstimateLight(*shown, wanted);
    if (wanted_for_ != solver_ || wanted.edit.convergence != coefficients_convergence_) {
      WantCoefficients(wanted, &worker);
    }
  }
}

/// A solver for the objects at these places.
Result<void> BackgroundLight::Place(const std::vector<ObjectPlace>& objects) {
  placed_objects_ = objects;
  const std::size_t phantoms = setup_.placed.size() - objects.size();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    setup_.placed[phantoms + i].linear = LinearOf(objects[i]);
    setup_.placed[phantoms + i].translation_m = objects[i].translation_m;
  }
  compositor::LightSolverOptions options;
  options.rays_per_vertex = kFewRays;
  options.max_patches = setup_.light.overrides.max_patches.value_or(options.max_patches);
  PLEINAIR_ASSIGN_OR_RETURN(solver_, compositor::LightSolver::Create(setup_.placed, options));
  coefficients_.reset();  // They are another scene's.
  made_for_.reset();
  return {};
}

bool BackgroundLight::NeedsLight(const Wanted& wanted) const {
  if (!made_for_ || !(*made_for_ == wanted)) return true;
  const sky::SunPosition sun = scene::SunOver(WithEdit(setup_.scene, wanted.edit).place_time,
                                              wanted.time.PlusSeconds(wanted.edit.later_s));
  return !IsNearSun(made_sun_, sun);
}

/// What the user says of sun and sky, where he does, under the sun of a moment.
void BackgroundLight::UseOverriddenSky(UtcTime time, compositor::SkyState* skies) const {
  const auto given = compositor::OverriddenSky(setup_.scene, setup_.light.overrides,
                                               scene::SunOver(setup_.scene.place_time, time));
  if (!given) return;
  skies->source = given->skies;
  skies->scale = given->sky_radiance_scale;
}

LightingRequest BackgroundLight::LightingRequestFor(const Wanted& wanted) {
  scene::SceneDescription scene = setup_.scene;
  scene.marker.heading = heading_;
  scene = WithEdit(scene, wanted.edit);
  if (!wanted.edit.sky) {
    skies_ = found_skies_.source ? found_skies_ : setup_.skies;
    skies_of_.reset();
  } else if (wanted.edit.sky != skies_of_) {
    sky::SkyConditions conditions;
    conditions.turbidity = wanted.edit.sky->turbidity;
    conditions.cloud_cover = wanted.edit.sky->cloud_cover;
    auto source = sky::SkySource::Create({sky::SkyModelKind::kAtmosphere, 0}, conditions);
    // Outside what the sky model takes, the last one stays.
    if (source) skies_ = {*std::move(source), {1.0, 1.0, 1.0}};
    skies_of_ = wanted.edit.sky;
  }
  // Whether trees shade the ground is no matter of the air. With a heading given as well nothing is
  // looked at anew (MayEstimate), and what shades it under that one is not known.
  if (wanted.edit.sky)
    skies_.unmodelled_shadows = wanted.edit.heading_deg || found_skies_.unmodelled_shadows;
  return {wanted.time.PlusSeconds(wanted.edit.later_s),
          scene.place_time,
          scene.marker,
          skies_,
          solver_,
          coefficients_,
          wanted.marker_reflectance,
          setup_.response};
}

void BackgroundLight::Make(const Wanted& wanted) {
  auto light = std::make_shared<BakedLighting>(LightingRequestFor(wanted));
  light->objects = placed_objects_;
  made_for_ = wanted;
  made_sun_ = light->sun;
  const std::lock_guard lock(mutex_);
  progress_.heading_deg = ToDegrees(light->request.marker.heading);
  newest_ = std::move(light);
}

/// Whether what frames show is the light that the scene is drawn in: not of another time or place.
bool BackgroundLight::MayEstimate(const Wanted& wanted) const {
  return !setup_.scene.phantoms.empty() && wanted.marker_reflectance.size_m > 0.0 &&
         !(wanted.edit.sky && wanted.edit.heading_deg) && wanted.edit.later_s == 0.0 &&
         wanted.edit.latitude_deg == setup_.scene.place_time.latitude_deg &&
         wanted.edit.longitude_deg == setup_.scene.place_time.longitude_deg;
}

void BackgroundLight::EstimateLight(const Shown& shown, const Wanted& wanted) {
  if (!MayEstimate(wanted)) {
    estimator_.reset();
    const std::lock_guard lock(mutex_);
    progress_.frames_in_estimate = 0;
    return;
  }
  if (!estimator_) {
    estimator_ = std::make_unique<compositor::LightEstimator>(
        solver_, setup_.camera, wanted.marker_reflectance, setup_.scene, setup_.light.overrides,
        shown.time, setup_.response);
  }
  estimator_->Add(shown.frame->rgb.view(), shown.camera_from_marker);
  {
    const std::lock_guard lock(mutex_);
    progress_.frames_in_estimate = estimator_->frames();
  }
  if (estimator_->frames() < kLightFrames) return;
  const compositor::LightEstimate found = estimator_->Estimate(&light_filter_);
  estimator_.reset();
  found_skies_ = found.skies;
  if (found_skies_.source) UseOverriddenSky(shown.time, &found_skies_);
  heading_ = found.heading;
  made_for_.reset();
  const std::lock_guard lock(mutex_);
  progress_.measured = found.measured;
  progress_.frames_in_estimate = 0;
  next_estimate_ = shown.time.PlusSeconds(kBetweenMeasurements_s);
  shown_.reset();  // It came meanwhile, and would begin the next look too early.
}

void BackgroundLight::WantCoefficients(const Wanted& wanted,
                                       compositor::CoefficientWorker* worker) {
  wanted_for_ = solver_;
  coefficients_convergence_ = wanted.edit.convergence;
  compositor::CoefficientOptions options;
  options.convergence = coefficients_convergence_;
  options.division = setup_.light.sky_division;
  // What is being tried out would fill the disk: each place of an object has a file of its own.
  const bool as_begun = wanted.edit.objects == setup_.edit.objects &&
                        wanted.edit.convergence == setup_.edit.convergence;
  if (as_begun) options.cache = setup_.light.cache;
  worker->Want(solver_, scene::MarkerFromWorld(setup_.scene.marker) * Vec3{0.0, 0.0, 1.0}, options);
}

/// Where new ones are there, of the scene as it stands now.
void BackgroundLight::TakeCoefficients(const compositor::CoefficientWorker& worker) {
  const auto newest = worker.Newest();
  {
    const std::lock_guard lock(mutex_);
    progress_.coefficients = wanted_for_ ? worker.progress() : 0.0;
  }
  if (!newest || newest->solver != solver_ || newest->coefficients == coefficients_) return;
  coefficients_ = newest->coefficients;
  made_for_.reset();
  if (coefficients_->kept) return;
  const std::lock_guard lock(mutex_);
  progress_.failed_to_keep = true;
}

}  // namespace pleinair::session
