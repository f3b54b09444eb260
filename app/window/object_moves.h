#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/window/picture_view.h"
#include "session/scene_edit.h"

namespace pleinair::app {

/// A virtual object as a hand takes hold of it: the box around its model, model coordinates.
struct ObjectBox {
  std::string name;
  Vec3 min, max;
};

/// Corner 0…7 of an object's box where it stands, marker coordinates; bit 0 is x, 1 y, 2 z.
Vec3 BoxCorner(const ObjectBox& box, const session::ObjectPlace& place, int corner);
/// The middle of the box's lowest face, as `up` has it.
Vec3 BoxFoot(const ObjectBox& box, const session::ObjectPlace& place, Vec3 up);

/// The object whose box a line of sight meets first.
std::optional<int> PickObject(std::span<const ObjectBox> boxes,
                              std::span<const session::ObjectPlace> places, const Sight& sight);

/// Directions on level ground as the viewer has them: unit, marker coordinates.
struct ViewerAxes {
  Vec3 right, away;
};
ViewerAxes AxesOf(const Transform<Camera, Marker>& camera_from_marker, Vec3 up);

/// Moves so that the point of the object that a mouse took hold of follows the mouse: over level
/// ground, from one line of sight to the next.
session::ObjectPlace DraggedLevel(const session::ObjectPlace& place, const Sight& from,
                                  const Sight& to, Vec3 hold, Vec3 up);
/// The same up and down, on an upright plane that faces the viewer.
session::ObjectPlace DraggedUpright(const session::ObjectPlace& place, const Sight& from,
                                    const Sight& to, Vec3 hold, Vec3 up);
/// Turned about the upright through the middle of its foot.
session::ObjectPlace Turned(const ObjectBox& box, const session::ObjectPlace& place, double degrees,
                            Vec3 up);
/// Made larger, its foot staying.
session::ObjectPlace Scaled(const ObjectBox& box, const session::ObjectPlace& place, double factor,
                            Vec3 up);

}  // namespace pleinair::app
