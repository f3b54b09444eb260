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

/// All that the light of a moment is made from; nothing in it changes meanwhile.
struct LightingRequest {
  UtcTime time;
  scene::PlaceTime place;
  scene::MarkerDescription marker;
  compositor::SkyState skies;
  std::shared_ptr<const compositor::LightSolver> solver;
  /// Of the solver's scene: the light of any moment in milliseconds. Null: rays are traced.
  std::shared_ptr<const compositor::DaylightCoefficients> coefficients;
  scene::MarkerReflectance marker_reflectance;
  CameraResponse response;
};

/// Sun, sky and the light among surfaces at one moment, and the meter that knows what light it
/// leaves on the marker. Neither copied nor moved: its parts refer to each other.
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
  std::optional<compositor::MarkerLightMeter> meter;  ///< Where the order knows a print.
  std::vector<ObjectPlace> objects;  ///< Where they stood; empty: as the scene describes them.
};

/// Whether the sun is still where its light among surfaces was made for, so that this need not be
/// made anew.
bool IsNearSun(const sky::SunPosition& made_for, const sky::SunPosition& now);

}  // namespace pleinair::session
