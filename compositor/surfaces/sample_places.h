#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace pleinair::compositor {

/// Places in a pixel, relative to its center, in pixels: each coordinate is within ±½. `count`: 4,
/// 8, 16, 32 or 64.
///
/// 64 places are four copies of a lattice of 16, turned by quarters. The lattice has one place in
/// each of 16 rows and columns, so that edges near the axes do not step. Its generator (11) and
/// shift were chosen among all by the error of the areas that random straight edges cover. It is
/// 0.012 RMS and 0.08 at most; with four samples 0.09 and 0.31. Fewer places are those of
/// Hammersley with the radical inverse in base 2, mirrored; four are the usual rotated grid.
std::vector<glm::vec2> SamplePlaces(int count);

}  // namespace pleinair::compositor
