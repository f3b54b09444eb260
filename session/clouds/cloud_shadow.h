#pragma once

#include <memory>
#include <vector>

#include "base/frames.h"
#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/light/sun_transmittance_map.h"
#include "sky/clouds/cloud_shadow.h"
#include "sky/clouds/cloud_shadow_map.h"

namespace pleinair::session {

/// What layers of clouds leave of the sun over a scene at one moment.
struct CloudShadow {
  /// Mean transmittance over the scene, at least kLeastSun: the strength of the sun in LightMix.
  double sun = 1.0;
  double at_marker = 1.0;  ///< Transmittance at the marker.
  /// For Composer::SetSunTransmittance(), relative to `sun`.
  std::shared_ptr<const compositor::SunTransmittanceMap> map;

  static constexpr double kLeastSun = 1e-3;
};

/// The place of a scene: the bounding box of its surfaces, in axes of east, north and up. `meshes`
/// are in marker coordinates.
clouds::GroundBox BoxOf(const std::vector<compositor::LitMesh>& meshes,
                        const Mat3& marker_from_world);

/// `seconds`: age of the layers.
CloudShadow MakeCloudShadow(const clouds::CloudFields& fields, const clouds::GroundBox& box,
                            Direction<World> to_sun, const Mat3& marker_from_world, double seconds);

}  // namespace pleinair::session
