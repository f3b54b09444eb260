#pragma once

#include <memory>

#include "base/vector.h"
#include "compositor/models/animation/model_animation.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// A model placed in the scene, for the light computation.
struct PlacedModel {
  std::shared_ptr<const Model> model;
  Mat3 linear;              ///< Rotation and scale, marker from model coordinates.
  Vec3 translation_m;       ///< Position of the model's origin, marker coordinates.
  bool is_phantom = false;  ///< Geometry of a real surface; else a virtual object.
  /// How a virtual object changes its shape. By default it does not.
  Playback playback = {};
};

/// The box around all shapes of a model with a playback, marker coordinates.
ModelBounds BoundsOfShapes(const PlacedModel& placed);

}  // namespace pleinair::compositor
