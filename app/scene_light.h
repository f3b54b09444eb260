#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/scene_edit.h"
#include "base/camera_response.h"
#include "base/utc_time.h"
#include "compositor/daylight_coefficients.h"
#include "compositor/light_meter.h"
#include "compositor/light_solver.h"
#include "compositor/scaled_daylight.h"
#include "compositor/seen_sunlight.h"
#include "devices/scene_description.h"
#include "sky/sky_model.h"
#include "sky/sun_position.h"

namespace pleinair::app {

/// The sun over a place at a moment.
sky::SunPosition SunOver(const devices::PlaceTime& place, UtcTime time);

/// Skies of a day whose light was measured or stated.
struct DaySkies {
  std::shared_ptr<const sky::SkySource> source;
  LinearRgb scale{1.0, 1.0, 1.0};  ///< To multiply the sky with; the sun stays.
  /// Whether trees and the like may shade what the phantoms leave in the sun.
  bool other_shade = true;
  /// How much of the sun these leave, across its rays; null: all. A light's own is null once the
  /// sun has left the place that the map was made for.
  std::shared_ptr<const compositor::SeenSunlight> sunlight{};
  /// To multiply the camera's gain with: above 1 where leaves shade all of the print.
  LinearRgb print_shade{1.0, 1.0, 1.0};
};

/// All that the light of a moment is made from; nothing in it changes meanwhile.
struct LightOrder {
  UtcTime time;
  devices::PlaceTime place;
  devices::MarkerDescription marker;
  DaySkies skies;
  std::shared_ptr<const compositor::LightSolver> solver;
  /// Of the solver's scene: the light of any moment in milliseconds. Null: rays are traced.
  std::shared_ptr<const compositor::DaylightCoefficients> coefficients;
  compositor::MarkerPrint print;
  CameraResponse response;
};

/// Sun, sky and the light among surfaces at one moment, and the meter that knows what light it
/// leaves on the marker. Neither copied nor moved: its parts refer to each other.
struct SceneLight {
  explicit SceneLight(const LightOrder& order);
  SceneLight(const SceneLight&) = delete;
  SceneLight& operator=(const SceneLight&) = delete;

  LightOrder order;
  Mat3 marker_from_world;
  sky::SunPosition sun;
  std::shared_ptr<const sky::SkyModel> model;
  compositor::ScaledDaylight daylight;
  std::vector<compositor::LitMesh> meshes;
  LinearRgb from_below;                         ///< LightSolver::RadianceFromBelow().
  std::optional<compositor::LightMeter> meter;  ///< Where the order knows a print.
  std::vector<ObjectPlace> objects;  ///< Where they stood; empty: as the scene describes them.
};

/// Marker coordinates from east-north-up, from the marker's stated heading (devices/
/// scene_description.h).
Mat3 MarkerFromWorld(const devices::MarkerDescription& marker);

/// Whether the sun is still where its light among surfaces was made for, so that this need not be
/// made anew.
bool IsNearSun(const sky::SunPosition& made_for, const sky::SunPosition& now);

}  // namespace pleinair::app
