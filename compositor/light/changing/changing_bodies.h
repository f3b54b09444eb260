#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/models/animation/model_animation.h"
#include "compositor/models/placed_model.h"
#include "sky/sky_model.h"

namespace pleinair::compositor {

/// The virtual objects of a scene that change their shape, and their light: on them, and on still
/// surfaces near them (docs/method/changing-surfaces.md).
class ChangingBodies {
 public:
  /// Takes the models with a playback; null if there are none. Errors (system): a program without
  /// ray queries.
  static Result<std::unique_ptr<ChangingBodies>> Create(const std::vector<PlacedModel>& scene);
  virtual ~ChangingBodies() = default;

  /// Returns whether a placed model is one of the bodies.
  virtual bool Has(int placed_model) const = 0;
  /// Sets the shape of a body, as ModelAnimation::At(), from the next Update() on.
  virtual void SetShape(int placed_model, std::span<const MeshShape> shape) = 0;
  /// As Composer::MoveModel(); applies from the next SetShape() on.
  virtual void Move(int placed_model, const Mat3& linear, Vec3 translation_m) = 0;

  /// Sets the still surfaces in their light without the bodies, and the daylight. Errors: no
  /// memory.
  virtual Result<void> SetLight(const std::vector<LitMesh>& still, const sky::SkyModel& daylight,
                                const Mat3& marker_from_world) = 0;
  /// What Update() changed.
  enum class Changed { kNothing, kShape, kTriangles };
  /// Follows the shapes and refreshes a part of the light. Errors: no memory for other triangles.
  virtual Result<Changed> Update() = 0;

  /// All surfaces in their light: the still ones, then the bodies from first_body() on.
  virtual const std::vector<LitMesh>& meshes() const = 0;
  virtual std::size_t first_body() const = 0;
};

}  // namespace pleinair::compositor
