#pragma once

#include <optional>

#include "base/vector.h"
#include "scene/scene_description.h"

namespace pleinair::app {

/// A virtual pole for finding north: the user aligns its shadow with a real pole's shadow. Marker
/// coordinates.
struct NorthPole {
  Vec3 foot;
  double height_m = 1.0;

  /// Tip of the shadow on level ground; nothing if the sun is too low.
  std::optional<Vec3> ShadowTip(const scene::MarkerDescription& marker, Vec3 to_sun_in_world) const;
};

/// Up direction, marker coordinates.
Vec3 UpOf(const scene::MarkerDescription& marker);

/// Returns the marker heading, degrees 0…360, at which a pole's shadow points from its foot to
/// `towards`. Nothing if the sun does not shine or `towards` is the foot.
std::optional<double> HeadingForShadow(const scene::MarkerDescription& marker,
                                       const NorthPole& pole, Vec3 towards, Vec3 to_sun_in_world);

}  // namespace pleinair::app
