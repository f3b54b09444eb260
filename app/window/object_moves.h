#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/window/picture_view.h"
#include "session/scene_edit.h"

namespace pleinair::app {

/// A virtual object for mouse interaction: the bounding box of its model, model coordinates.
struct ObjectBox {
  std::string name;
  Vec3 min, max;
};

/// Corner 0…7 of a placed object's box, marker coordinates; bit 0 is x, 1 y, 2 z.
Vec3 BoxCorner(const ObjectBox& box, const session::ObjectPlace& place, int corner);
/// Centre of the box, moved along `up` to the height of its lowest corner.
Vec3 BoxFoot(const ObjectBox& box, const session::ObjectPlace& place, Vec3 up);

/// Returns the object whose box a viewing ray hits first.
std::optional<int> PickObject(std::span<const ObjectBox> boxes,
                              std::span<const session::ObjectPlace> places, const Sight& sight);

/// The viewer's horizontal axes: unit, marker coordinates.
struct ViewerAxes {
  Vec3 right, away;
};
ViewerAxes AxesOf(const Transform<Camera, Marker>& camera_from_marker, Vec3 up);

/// Translates over level ground, so that the grabbed point `hold` follows the mouse from one
/// viewing ray to the next.
session::ObjectPlace DraggedLevel(const session::ObjectPlace& place, const Sight& from,
                                  const Sight& to, Vec3 hold, Vec3 up);
/// Translates vertically in the same way, on an upright plane that faces the viewer.
session::ObjectPlace DraggedUpright(const session::ObjectPlace& place, const Sight& from,
                                    const Sight& to, Vec3 hold, Vec3 up);
/// Rotates about the vertical axis through the centre of its foot.
session::ObjectPlace Turned(const ObjectBox& box, const session::ObjectPlace& place, double degrees,
                            Vec3 up);
/// Scales with a fixed foot.
session::ObjectPlace Scaled(const ObjectBox& box, const session::ObjectPlace& place, double factor,
                            Vec3 up);

}  // namespace pleinair::app
