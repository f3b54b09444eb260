#pragma once

#include <optional>
#include <vector>

#include "app/window/picture_view.h"
#include "scene/scene_description.h"
#include "session/scene_edit.h"

namespace pleinair::app {

/// What the mouse holds of the described surfaces of a scene.
struct SurfaceGrip {
  int phantom = 0;            ///< Index among the scene's phantoms.
  std::optional<int> corner;  ///< Of a wall; nothing: the surface itself.
  Vec3 hold;                  ///< The point that was grabbed, marker coordinates.
};

/// Polygons of a described surface in marker coordinates; none for a model file.
std::vector<std::vector<Vec3>> PlacedPolygons(const scene::ModelReference& phantom);

/// Returns the surface that a viewing ray hits first, or the corner of a wall within
/// `corner_radius` of the ray (radians), which comes first. `scene`: with the edit.
std::optional<SurfaceGrip> PickSurface(const scene::SceneDescription& scene, const Sight& sight,
                                       double corner_radius);

/// Moves a surface from one viewing ray to the next: a box over level ground, or vertically if
/// `upright`; a wall along its normal, or one of its corners within its plane; ground vertically.
/// `start`: as it was when it was grabbed. Nothing if the surface cannot be so: a wall with a dent,
/// ground above a marker's centre, or a ray that does not reach it.
std::optional<session::SurfacePlace> DraggedSurface(const scene::SceneDescription& scene,
                                                    const session::SurfacePlace& start,
                                                    const SurfaceGrip& grip, const Sight& from,
                                                    const Sight& to, bool upright);

/// Height of the marker above the ground of a scene, metres.
double GroundHeight(const scene::SceneDescription& scene, const scene::ModelReference& ground);

}  // namespace pleinair::app
