#pragma once

#include <vector>

namespace pleinair::app {

/// Where and when a ray starts: on the stop, in diameters from its centre, in the pixel, 0…1, and
/// in the exposure, −½…½.
struct RayPlaces {
  double stop_x, stop_y, x, y, time;
};

/// The 4,096 rays of a pixel, each with its own places, from a Halton sequence (J. H. Halton,
/// Numerische Mathematik 2, 1960) with the bases 2, 3, 5, 7 and 11.
std::vector<RayPlaces> TracedRays();

}  // namespace pleinair::app
