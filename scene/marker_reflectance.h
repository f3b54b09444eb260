#pragma once

#include "base/vector.h"

namespace pleinair::scene {

/// Layout and reflectance of the marker surface: where it is white and black, and how much it
/// reflects. Metres.
struct MarkerReflectance {
  double size_m = 0.0;         ///< Edge of the outer black square.
  double board_size_m = 0.0;   ///< Edge of the white margin around it; at least size_m.
  double black_band_m = 0.0;   ///< Width of the uniformly black band along the outer edge.
  double albedo_black = 0.04;  ///< Diffuse reflectances, 0…1.
  double albedo_white = 0.80;
  bool operator==(const MarkerReflectance&) const = default;
};

}  // namespace pleinair::scene
