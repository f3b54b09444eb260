#pragma once

#include <optional>
#include <vector>

#include "app/window/picture_view.h"
#include "scene/scene_description.h"
#include "session/scene_edit.h"

namespace pleinair::app {

/// The described surface of a scene that the mouse holds, or a corner of it.
struct SurfaceGrip {
  int phantom = 0;            ///< Index among the scene's phantoms.
  std::optional<int> corner;  ///< Index of a wall's corner; nothing: the whole surface.
  Vec3 hold;                  ///< The point that was grabbed, marker coordinates, metres.
};

/// Polygons of a described surface in marker coordinates, metres; none for a model file.
std::vector<std::vector<Vec3>> PlacedPolygons(const scene::ModelReference& phantom);

/// Returns what a viewing ray picks: a corner of a wall within `corner_radius` (radians) of the
/// ray, otherwise the first surface that the ray hits. Nothing: neither. `scene`: with the edit.
std::optional<SurfaceGrip> PickSurface(const scene::SceneDescription& scene, const Sight& sight,
                                       double corner_radius);

/// Moves a surface from one viewing ray to another. A box moves over level ground, or vertically if
/// `upright`. A wall moves along its normal, a corner of it within its plane. Ground moves
/// vertically. `start`: the place when it was grabbed. Nothing if the new place is not allowed: a
/// wall with a dent, ground above the marker's centre or over 1 km below it. Nothing also for a ray
/// that does not reach the surface.
std::optional<session::SurfacePlace> DraggedSurface(const scene::SceneDescription& scene,
                                                    const session::SurfacePlace& start,
                                                    const SurfaceGrip& grip, const Sight& from,
                                                    const Sight& to, bool upright);

/// Height of the marker above the ground of a scene, metres.
double GroundHeight(const scene::SceneDescription& scene, const scene::ModelReference& ground);

}  // namespace pleinair::app
