#pragma once

#include <optional>

#include "base/vector.h"
#include "scene/scene_description.h"

namespace pleinair::app {

/// A virtual pole whose shadow is laid over that of a real one to find north. Marker coordinates.
struct NorthPole {
  Vec3 foot;
  double height_m = 1.0;

  /// The shadow's tip on level ground; nothing where the sun is too low for one.
  std::optional<Vec3> ShadowTip(const scene::MarkerDescription& marker, Vec3 to_sun_in_world) const;
};

/// Up, marker coordinates.
Vec3 UpOf(const scene::MarkerDescription& marker);

/// The marker's heading, degrees 0…360, at which a pole's shadow points from its foot to `towards`;
/// nothing where the sun does not shine or `towards` is the foot.
std::optional<double> HeadingForShadow(const scene::MarkerDescription& marker,
                                       const NorthPole& pole, Vec3 towards, Vec3 to_sun_in_world);

}  // namespace pleinair::app
