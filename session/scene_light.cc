#include "session/scene_light.h"

#include <utility>

#include "compositor/light/scaled_sky.h"
#include "compositor/photometry/light_filter.h"
#include "compositor/photometry/sky_fit.h"
#include "scene/marker_heading.h"
#include "scene/sun_over_place.h"

namespace pleinair::session {
namespace {

compositor::MeasuredLight WithoutMeasuredSun(const compositor::MeasuredLight& measured) {
  compositor::MeasuredLight heading;
  heading.heading_source = measured.heading_source;
  heading.heading_offset = measured.heading_offset;
  heading.heading_error = measured.heading_error;
  heading.evidence = measured.evidence;
  return heading;
}

}  // namespace

std::set<int> UncoloredSurfaces(const std::vector<scene::ModelReference>& phantoms) {
  std::set<int> uncolored;
  for (std::size_t i = 0; i < phantoms.size(); ++i) {
    const auto& surface = phantoms[i].surface;
    if (surface && !surface->has_color) uncolored.insert(static_cast<int>(i));
  }
  return uncolored;
}

compositor::LightSolverOptions SolverOptionsOf(const LightOptions& options) {
  compositor::LightSolverOptions solving;
  solving.max_patches = options.overrides.max_patches.value_or(solving.max_patches);
  return solving;
}

SceneLight::SceneLight(std::shared_ptr<const compositor::LightSolver> solver,
                       const scene::SceneDescription& scene, const LightOptions& options)
    : solver_(std::move(solver)), options_(options) {
  skies_.source = compositor::DescribedSky(scene);
  const clouds::CloudFields fields = clouds::MakeFields(scene.clouds.layers);
  if (options.changes == LightChangeMode::kStated) {
    clouds_.stated.emplace(fields);
  } else {
    clouds_.mirrored = fields;
  }
}

void SceneLight::Observe(CameraImageView image, const CameraModel& camera,
                         const Transform<Camera, Marker>& camera_from_marker, UtcTime time,
                         const scene::SceneDescription& scene,
                         const scene::MarkerReflectance& marker_reflectance,
                         const CameraResponse& response, bool shows_marker) {
  if (!estimator_) {
    estimator_ = std::make_unique<compositor::LightEstimator>(
        std::shared_ptr<const compositor::PhantomRays>(solver_, &solver_->phantoms()), camera,
        marker_reflectance, scene, options_.overrides, time, response);
  }
  estimator_->Add(image, camera_from_marker, shows_marker);
}

std::optional<SceneLight::Conclusion> SceneLight::Conclude(const std::set<int>& uncolored) {
  if (!estimator_) return std::nullopt;
  compositor::LightFilter of_no_other_look;
  Conclusion found;
  found.light = estimator_->Estimate(&of_no_other_look);
  found.colors = estimator_->MeasureColors(found.light, uncolored);
  estimator_.reset();
  concluded_ = true;
  if (clouds_.stated) {
    // The frames may show any part of the stated clouds' light.
    skies_.unmodelled_shadows = found.light.skies.unmodelled_shadows;
    found.light.measured = WithoutMeasuredSun(found.light.measured);
  } else if (found.light.skies.source) {
    skies_ = found.light.skies;
  }
  return found;
}

Result<void> SceneLight::UseModels(const std::vector<compositor::PlacedModel>& placed) {
  PLEINAIR_ASSIGN_OR_RETURN(solver_,
                            compositor::LightSolver::Create(placed, SolverOptionsOf(options_)));
  coefficients_.reset();
  in_use_.reset();
  return {};
}

void SceneLight::Probe(CameraImageView image, const CameraModel& camera,
                       const Transform<Camera, Marker>& camera_from_marker,
                       std::int64_t frame_index, std::int64_t timestamp_ns,
                       const scene::MarkerReflectance& marker_reflectance,
                       const CameraResponse& response) {
  if (!follower_) {
    probed_ = solver_;
    follower_.emplace(probed_->phantoms(), camera, response);
  }
  follower_->Add(image, camera_from_marker, marker_reflectance, frame_index, timestamp_ns);
}

void SceneLight::Follow(const scene::SceneDescription& scene, UtcTime time,
                        const std::set<std::int64_t>& reference) {
  if (!follower_) return;
  const sky::SunPosition sun = scene::SunOver(scene.place_time, time);
  compositor::SkyFit sky{compositor::SunlitSky(scene)};
  if (concluded_) sky = {skies_.source, skies_.scale};
  if (const auto given = compositor::OverriddenSky(scene, options_.overrides, sun)) sky = *given;
  const auto day = sky.skies->ForSun(sun.ToSun(), sun.distance_au);
  follower_->Fit(compositor::ScaledSky(*day, sky.sky_radiance_scale, {1.0, 1.0, 1.0}),
                 scene::MarkerFromWorld(scene.marker), reference);
}

std::optional<compositor::ResponseEstimate> SceneLight::EstimateResponse(
    const std::set<std::int64_t>& frames) {
  if (!follower_) return std::nullopt;
  compositor::ResponseEstimate found = follower_->EstimateResponse(frames);
  if (found.conclusive) follower_->SetResponse(found.response);
  return found;
}

void SceneLight::Override(const scene::SceneDescription& scene, const sky::SunPosition& sun,
                          compositor::MeasuredLight* measured) {
  measured->sun_to_sky_stated =
      compositor::SunToSky(*compositor::DescribedSky(scene)->ForSun(sun.ToSun(), sun.distance_au));
  if (options_.overrides.heading_deg) {
    measured->heading_source = compositor::MeasuredLight::Source::kOverride;
  }
  const auto given = compositor::OverriddenSky(scene, options_.overrides, sun);
  if (!given) return;
  measured->sun_source = compositor::MeasuredLight::Source::kOverride;
  // Tree shade was measured under this sky.
  skies_.source = given->skies;
  skies_.scale = given->sky_radiance_scale;
}

std::shared_ptr<const compositor::DaylightCoefficients> SceneLight::Coefficients(
    const scene::MarkerDescription& marker, const compositor::CoefficientProgress& progress) {
  if (coefficients_) return coefficients_;
  compositor::CoefficientOptions options;
  options.cache = options_.cache;
  options.division = options_.sky_division;
  options.convergence = options_.convergence;
  coefficients_ = std::make_shared<const compositor::DaylightCoefficients>(solver_->Coefficients(
      scene::MarkerFromWorld(marker) * Vec3{0.0, 0.0, 1.0}, options, progress));
  return coefficients_;
}

LightingRequest SceneLight::Request(UtcTime time, const scene::SceneDescription& scene,
                                    const scene::MarkerReflectance& marker_reflectance,
                                    const CameraResponse& response) const {
  return {time,
          scene.place_time,
          scene.marker,
          skies_,
          solver_,
          coefficients_,
          marker_reflectance,
          response,
          clouds_.stated ? clouds_.stated->fields() : clouds_.mirrored,
          clouds_.stated.has_value()};
}

bool SceneLight::IsStale(const sky::SunPosition& sun) const {
  return !made_elsewhere_ && !(in_use_ && IsNearSun(in_use_->sun, sun));
}

void SceneLight::Use(std::shared_ptr<const BakedLighting> light, bool made_elsewhere, bool fades) {
  if (made_elsewhere) {
    if (in_use_ && fades) fade_.Begin(in_use_->meshes, light->meshes);
    made_elsewhere_ = true;
    skies_ = light->request.skies;
  }
  solver_ = light->request.solver;
  in_use_ = std::move(light);
}

const std::vector<compositor::LitMesh>* SceneLight::FadedMeshes(UtcTime time) {
  if (!fade_.on()) return nullptr;
  const std::vector<compositor::LitMesh>* mixed = fade_.At(time, in_use_->meshes);
  return mixed != nullptr ? mixed : &in_use_->meshes;
}

}  // namespace pleinair::session
