#pragma once

#include <optional>
#include <vector>

#include "base/vector.h"
#include "compositor/composer_options.h"
#include "scene/scene_description.h"

namespace pleinair::session {

/// Where a virtual object stands: as in devices::ModelReference.
struct ObjectPlace {
  Vec3 translation_m;
  Vec3 rotation_deg;
  double scale = 1.0;
  bool operator==(const ObjectPlace&) const = default;
};

/// Rotation and scale of a placed object, marker from model coordinates.
Mat3 LinearOf(const ObjectPlace& place);

/// How finely a live session draws (app/live/live_detail.h).
enum class Detail { kAutomatic, kFine, kFast, kCoarse };

/// What a person may change of a scene while it is shown. A plain value: panels edit a copy and
/// hand it over whole.
struct SceneEdit {
  double latitude_deg = 0.0, longitude_deg = 0.0;
  /// Added to the moment of each frame.
  double later_s = 0.0;
  /// Haze and clouds in place of those that were measured or that the scene states.
  struct Sky {
    double turbidity = 2.0;
    double cloud_cover = 0.0;
    bool operator==(const Sky&) const = default;
  };
  std::optional<Sky> sky;
  /// Of the marker, in place of what was measured or the scene states.
  std::optional<double> heading_deg;
  compositor::ComposerOptions drawing;
  Detail detail = Detail::kAutomatic;
  double convergence = 0.01;  ///< compositor::CoefficientOptions.
  std::vector<ObjectPlace> objects;
  /// Drawn objects keep the brightness that the marker was last read to give them.
  bool lock_exposure = false;
  bool operator==(const SceneEdit&) const = default;
};

/// The scene as it is described.
SceneEdit UneditedScene(const scene::SceneDescription& scene,
                        const compositor::ComposerOptions& drawing,
                        double convergence = SceneEdit{}.convergence);

/// A description with an edit's places of objects, heading and place; the sky in words stays.
scene::SceneDescription WithEdit(const scene::SceneDescription& scene, const SceneEdit& edit);

/// The haze and clouds that a scene's words stand for (sky/daylight.h).
SceneEdit::Sky DescribedAir(const scene::SceneDescription& scene);

}  // namespace pleinair::session
