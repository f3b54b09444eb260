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
#include "session/clouds/clouded_day.h"
#include "session/scene_edit.h"
#include "sky/clouds/cloud_shadow.h"
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
  /// Layers of clouds at their age of `time`; empty: none.
  clouds::CloudFields clouds = {};
  /// True: their sky lights the scene. False: `skies` do, and the layers show in reflections.
  bool clouds_rule = true;

  /// Age of the layers at a time: seconds since the scene begins.
  double CloudSeconds(UtcTime at) const;
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
  /// Null without layers of clouds that rule the light. The sun is the one above them.
  std::shared_ptr<const CloudedDay> clouded;
  std::shared_ptr<const sky::SkyModel> model;
  compositor::ScaledSky daylight;
  std::vector<compositor::LitMesh> meshes;
  /// What glossy surfaces mirror, under layers that do not rule the light; else null.
  std::shared_ptr<const sky::SkyModel> mirrored;
  LinearRgb from_below;                               ///< LightSolver::RadianceFromBelow().
  std::optional<compositor::MarkerLightMeter> meter;  ///< Empty where the request has no marker.
  std::vector<ObjectPlace> objects;    ///< Positions of the objects; empty: as described.
  std::vector<SurfacePlace> phantoms;  ///< Positions of the phantoms; empty: as described.
};

/// The skies of a request without its clouds, for the sun at a time.
std::unique_ptr<sky::SkyModel> ClearSkyOf(const LightingRequest& request,
                                          const sky::SunPosition& sun);

/// True if the sun is still near the position of the baked indirect illumination, so that this need
/// not be computed again.
bool IsNearSun(const sky::SunPosition& made_for, const sky::SunPosition& now);

}  // namespace pleinair::session
