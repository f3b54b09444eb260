#pragma once

#include <optional>
#include <vector>

#include "base/vector.h"
#include "compositor/composer_options.h"
#include "scene/scene_description.h"

namespace pleinair::compositor {
struct PlacedModel;
}

namespace pleinair::session {

/// Placement of a virtual object, as in devices::ModelReference.
struct ObjectPlace {
  Vec3 translation_m;
  Vec3 rotation_deg;
  double scale = 1.0;
  bool operator==(const ObjectPlace&) const = default;
};

/// Placement of a phantom that the scene describes without a file (scene/described_surface.h).
struct SurfacePlace {
  Vec3 translation_m;           ///< As in scene::ModelReference.
  std::vector<Vec3> corners_m;  ///< Corners of a wall in its own coordinates; else empty.
  bool operator==(const SurfacePlace&) const = default;
};

/// Rotation about x, then y, then z.
Mat3 RotationXyz(Vec3 degrees);

/// Rotation and scale of a placed object, marker from model coordinates.
Mat3 LinearOf(const ObjectPlace& place);

/// Places a model in marker coordinates.
void MoveTo(const ObjectPlace& place, compositor::PlacedModel* model);

/// Level of detail of a live session (app/live/live_detail.h).
enum class Detail { kAutomatic, kFine, kFast, kCoarse };

/// Changes that a user makes to a scene while it is shown. A plain value: panels edit a copy and
/// pass it on as a whole.
struct SceneEdit {
  double latitude_deg = 0.0, longitude_deg = 0.0;
  /// Added to the time of each frame.
  double later_s = 0.0;
  /// Haze and clouds that replace the estimated or described ones.
  struct Sky {
    double turbidity = 2.0;
    double cloud_cover = 0.0;
    bool operator==(const Sky&) const = default;
  };
  std::optional<Sky> sky;
  /// Heading of the marker that replaces the estimated or described one.
  std::optional<double> heading_deg;
  compositor::ComposerOptions drawing;
  Detail detail = Detail::kAutomatic;
  double convergence = 0.01;  ///< compositor::CoefficientOptions.
  std::vector<ObjectPlace> objects;
  /// One per phantom. Those with a file stay where they are.
  std::vector<SurfacePlace> phantoms;
  /// Keeps the exposure scale of the last frame (ExposureMeter::SetLocked()).
  bool lock_exposure = false;
  bool operator==(const SceneEdit&) const = default;
};

/// The scene as described, without changes.
SceneEdit UneditedScene(const scene::SceneDescription& scene,
                        const compositor::ComposerOptions& drawing,
                        double convergence = SceneEdit{}.convergence);

/// Applies an edit's objects, surfaces, heading and location to a description. The described sky
/// stays.
scene::SceneDescription WithEdit(const scene::SceneDescription& scene, const SceneEdit& edit);

/// Haze and clouds of a scene description (sky/daylight.h).
SceneEdit::Sky DescribedAir(const scene::SceneDescription& scene);

}  // namespace pleinair::session
