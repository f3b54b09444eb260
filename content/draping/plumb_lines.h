#pragma once

#include <span>

#include "base/frames.h"
#include "content/draping/surface_index.h"
#include "content/georeference/local_frame.h"

namespace pleinair::content {

/// Moves the points of a map along their own plumb lines to the height of the surface, by at most
/// two steps. The vertical of a place d from the marker leans by d/R against that of the marker: at
/// 2 km, ground that is 100 m higher lies 31 mm beside the point at the marker's height. Without
/// this step, draping along the marker's vertical would leave that error. Points over no surface
/// stay. `geodetic`: the places of `points`, in the frame of the map.
void MoveAlongPlumbLines(const LocalFrame& frame, const SurfaceIndex& surface,
                         const SurfaceRule& rule, std::span<const GeodeticPoint> geodetic,
                         std::span<Point<World>> points);

}  // namespace pleinair::content
