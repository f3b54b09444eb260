#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/vector.h"

namespace pleinair::compositor {

/// How much of the sun comes through what no phantom stands for (trees), as a map across the sun's
/// rays: what a ray shows on the real surface at its end holds for whatever virtual thing it meets
/// before. Marker coordinates, metres.
struct SunTransmittanceMap {
  Vec3 to_sun;                      ///< Unit, of the sun whose rays these are.
  Vec3 across_x, across_y;          ///< Unit; with the sun's rays a right-handed frame.
  double first_x = 0, first_y = 0;  ///< Along these, of the first cell's middle.
  double cell_m = 0.0;
  int width = 0, height = 0;
  std::vector<float> share;  ///< 0…1, row by row.

  /// Between the cells' middles linear, beyond the border the border's; 1 of an empty map.
  double At(Vec3 point) const;
  /// Whether a sun stands so near to the map's that its shadows still lie about where the map has
  /// them. `direction` unit.
  bool HoldsFor(Vec3 direction) const;
  /// The rows that give texture coordinates of (x, y, z, 1); not of an empty map.
  std::array<std::array<float, 4>, 2> TextureFromMarker() const;
};

/// A place on a real surface that the phantoms leave in the sun.
struct SunlitSample {
  Vec3 point;
  double share = 1.0;        ///< Of the sun that is there.
  double footprint_m = 0.0;  ///< Edge of a pixel there.
};

/// The map that surface samples tell of; between them it is smooth. Empty without surface samples,
/// and where the few that there are all lie beyond its border.
SunTransmittanceMap BuildSunTransmittanceMap(Vec3 to_sun,
                                             std::span<const SunlitSample> surface_samples);

}  // namespace pleinair::compositor
