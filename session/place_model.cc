// Loads and places the models of a scene, for scene_renderer.h.
#include <memory>
#include <utility>

#include "compositor/models/animation/model_animation.h"
#include "compositor/models/gltf_pose.h"
#include "compositor/surfaces/polygon_model.h"
#include "session/scene_edit.h"
#include "session/scene_renderer.h"

namespace pleinair::session {
namespace {

compositor::NormalsMode NormalsOf(scene::Shading shading) {
  switch (shading) {
    case scene::Shading::kFromFile:
      return compositor::NormalsMode::kFromFile;
    case scene::Shading::kFlat:
      return compositor::NormalsMode::kFlat;
    case scene::Shading::kSmooth:
      return compositor::NormalsMode::kSmooth;
  }
  return compositor::NormalsMode::kFromFile;
}

/// Loads the model of a reference, at rest, or with its animation if it plays one.
Result<compositor::AnimatedModel> ModelOf(const scene::ModelReference& reference, bool is_phantom,
                                          const scene::MarkerDescription& marker) {
  if (reference.surface) {
    const scene::DescribedSurface& surface = *reference.surface;
    return compositor::AnimatedModel{
        compositor::PolygonModel(surface.name, surface.polygons, surface.reflectance), nullptr};
  }
  const compositor::ModelFrame frame{reference.up, marker.upright ? UpAxis::kY : UpAxis::kZ,
                                     reference.unit_m.value_or(1.0),
                                     reference.origin == scene::ModelOrigin::kBottomCentre};
  const compositor::ModelOptions options{NormalsOf(reference.shading), is_phantom, frame};
  if (!reference.animation.empty() && !is_phantom) {
    return compositor::LoadAnimatedModel(reference.file, options, reference.animation);
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      compositor::Model model,
      compositor::LoadModel(reference.file, options,
                            {reference.animation, reference.animation_start_s}));
  return compositor::AnimatedModel{std::move(model), nullptr};
}

}  // namespace

Result<compositor::PlacedModel> PlaceModel(const scene::ModelReference& reference, bool is_phantom,
                                           const scene::MarkerDescription& marker) {
  PLEINAIR_ASSIGN_OR_RETURN(compositor::AnimatedModel loaded,
                            ModelOf(reference, is_phantom, marker));
  compositor::PlacedModel placed;
  placed.model = std::make_shared<const compositor::Model>(std::move(loaded.model));
  placed.is_phantom = is_phantom;
  placed.playback = {std::move(loaded.animation), reference.animation_start_s, reference.loop};
  MoveTo({reference.translation_m, reference.rotation_deg, reference.scale}, &placed);
  return placed;
}

}  // namespace pleinair::session
