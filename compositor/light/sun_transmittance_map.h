#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "base/vector.h"

namespace pleinair::compositor {

/// Sun transmittance of unmodelled geometry (trees), as a projective map along the sun's rays. A
/// ray is measured on the real surface at its end. The value also holds for virtual objects that
/// the ray meets before. Marker coordinates, metres.
struct SunTransmittanceMap {
  Vec3 to_sun;                      ///< Unit vector to the sun of this map.
  Vec3 across_x, across_y;          ///< Unit; a right-handed frame with the direction to the sun.
  double first_x = 0, first_y = 0;  ///< Middle of the first cell along these axes.
  double cell_m = 0.0;
  int width = 0, height = 0;
  std::vector<float> share;  ///< Transmittance 0…1, row-major.

  /// Bilinear between the cells' middles; the nearest border value outside; 1 for an empty map.
  double At(Vec3 point) const;
  /// Returns whether the sun is still close enough to the map's sun for its shadows to lie about
  /// where the map has them. `direction` is a unit vector.
  bool HoldsFor(Vec3 direction) const;
  /// Rows that map (x, y, z, 1) to texture coordinates. The map must not be empty.
  std::array<std::array<float, 4>, 2> TextureFromMarker() const;
};

/// What takes a part of the sun besides the scene's own geometry. Null or empty: nothing.
struct SunShade {
  /// Unmodelled objects, towards the virtual objects. On real surfaces the images show it.
  std::shared_ptr<const SunTransmittanceMap> trees = nullptr;
  /// Layers of clouds, on real and virtual surfaces alike. Relative to the sun's strength in
  /// LightMix, and above 1 where the clouds let more through than that.
  std::shared_ptr<const SunTransmittanceMap> clouds = nullptr;
};

/// A point on a real surface that no phantom shades.
struct SunlitSample {
  Vec3 point;
  double share = 1.0;        ///< Fraction of the sun that arrives there.
  double footprint_m = 0.0;  ///< Edge length of a pixel's footprint there.
};

/// Builds a smooth map from surface samples. The map is empty without samples, or if all of a few
/// samples lie outside its border.
SunTransmittanceMap BuildSunTransmittanceMap(Vec3 to_sun,
                                             std::span<const SunlitSample> surface_samples);

}  // namespace pleinair::compositor
