#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/camera_response.h"
#include "base/utc_time.h"
#include "compositor/light/daylight/daylight_coefficients.h"
#include "compositor/light/light_solver.h"
#include "compositor/light/scaled_sky.h"
#include "compositor/light/sun_transmittance_map.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "compositor/photometry/sky_state.h"
#include "scene/scene_description.h"
#include "session/scene_edit.h"
#include "sky/sky_model.h"
#include "sky/sun/sun_position.h"

namespace pleinair::session {

/// Inputs of the light at one moment. None of them changes during the computation.
struct LightingRequest {
  UtcTime time;
  scene::PlaceTime place;
  scene::MarkerDescription marker;
  compositor::SkyState skies;
  std::shared_ptr<const compositor::LightSolver> solver;
  /// Coefficients of the solver's scene, which give the light of any moment in milliseconds. Null:
  /// rays are traced.
  std::shared_ptr<const compositor::DaylightCoefficients> coefficients;
  scene::MarkerReflectance marker_reflectance;
  CameraResponse response;
};

/// Baked lighting at one moment: sun, sky, indirect illumination, and the light meter with the
/// predicted light on the marker. Neither copied nor moved, because its parts refer to each other.
struct BakedLighting {
  explicit BakedLighting(const LightingRequest& request);
  BakedLighting(const BakedLighting&) = delete;
  BakedLighting& operator=(const BakedLighting&) = delete;

  LightingRequest request;
  Mat3 marker_from_world;
  sky::SunPosition sun;
  std::shared_ptr<const sky::SkyModel> model;
  compositor::ScaledSky daylight;
  std::vector<compositor::LitMesh> meshes;
  LinearRgb from_below;                               ///< LightSolver::RadianceFromBelow().
  std::optional<compositor::MarkerLightMeter> meter;  ///< Empty where the request has no marker.
  std::vector<ObjectPlace> objects;    ///< Positions of the objects; empty: as described.
  std::vector<SurfacePlace> phantoms;  ///< Positions of the phantoms; empty: as described.
};

/// True if the sun is still near the position of the baked indirect illumination, so that this need
/// not be computed again.
bool IsNearSun(const sky::SunPosition& made_for, const sky::SunPosition& now);

}  // namespace pleinair::session
