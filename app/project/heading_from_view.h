#pragma once

#include <optional>

#include "base/frames.h"

namespace pleinair::app {

/// Heading of a marker, 0…360°, clockwise from the north of `view_heading_deg`. That is the
/// direction in which a level camera looked (GPSImgDirection of Exif 2.32). The camera's pose gives
/// the direction of view v in marker coordinates. A lying marker's heading is that of +y:
///
///   heading = view heading - atan2(v_x, v_y).
///
/// An upright marker's heading is that of -z: heading = view heading - atan2(v_x, -v_z). Nullopt:
/// the camera looked within 20° of the vertical, where a compass shows no view.
std::optional<double> HeadingFromView(double view_heading_deg,
                                      const Transform<Camera, Marker>& camera_from_marker,
                                      bool upright);

}  // namespace pleinair::app
