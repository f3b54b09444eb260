#include "session/clouds/cloud_shadow.h"

#include <algorithm>
#include <utility>

namespace pleinair::session {

clouds::GroundBox BoxOf(const std::vector<compositor::LitMesh>& meshes,
                        const Mat3& marker_from_world) {
  const Mat3 world_from_marker = marker_from_world.Transposed();
  clouds::GroundBox box;  // Contains the marker.
  for (const compositor::LitMesh& mesh : meshes) {
    for (const auto& position : mesh.positions) {
      const Vec3 at = world_from_marker * Vec3{position[0], position[1], position[2]};
      box.low_m = {std::min(box.low_m.x, at.x), std::min(box.low_m.y, at.y),
                   std::min(box.low_m.z, at.z)};
      box.high_m = {std::max(box.high_m.x, at.x), std::max(box.high_m.y, at.y),
                    std::max(box.high_m.z, at.z)};
    }
  }
  return box;
}

CloudShadow MakeCloudShadow(const clouds::CloudFields& fields, const clouds::GroundBox& box,
                            Direction<World> to_sun, const Mat3& marker_from_world,
                            double seconds) {
  clouds::CloudShadowMap world = clouds::MakeCloudShadowMap(fields, box, to_sun, seconds);
  CloudShadow shadow;
  shadow.sun = std::max(world.Mean(), CloudShadow::kLeastSun);
  shadow.at_marker = world.At({});
  compositor::SunTransmittanceMap map;
  map.to_sun = marker_from_world * to_sun.xyz;
  map.across_x = marker_from_world * world.across_x;
  map.across_y = marker_from_world * world.across_y;
  map.first_x = world.first_x_m;
  map.first_y = world.first_y_m;
  map.cell_m = world.texel_m;
  map.width = world.width;
  map.height = world.height;
  map.share = std::move(world.share);
  for (float& share : map.share) share = static_cast<float>(share / shadow.sun);
  shadow.map = std::make_shared<const compositor::SunTransmittanceMap>(std::move(map));
  return shadow;
}

}  // namespace pleinair::session
