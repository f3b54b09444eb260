#pragma once

#include "app/place/placement.h"
#include "export/plots/vector_drawing.h"

namespace pleinair::app {

/// Draws the layers from above, north up and east right, with the marker in the centre. The plan
/// reaches to the farthest vertex, at most to the radius, where lines are cut. Rings show the
/// distance. With a scene, an arrow shows the heading of the marker. Each layer has its color.
exports::VectorDrawing DrawPlacement(const Placement& placement);

}  // namespace pleinair::app
