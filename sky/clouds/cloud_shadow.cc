#include "sky/clouds/cloud_shadow.h"

#include <cmath>

#include "sky/clouds/sun_disc_rays.h"

namespace pleinair::clouds {
CloudFields MakeFields(const std::vector<CloudLayer>& layers) {
  CloudFields fields;
  fields.reserve(layers.size());
  for (const CloudLayer& layer : layers) fields.push_back(CloudField::Of(layer));
  return fields;
}

double SunTransmittance(const CloudFields& fields, Vec3 point_m, Direction<World> to_sun,
                        double seconds) {
  const Vec3 sun = to_sun.xyz;
  if (sun.z <= 0.0) return 0.0;
  const Vec3 across = sun.z < 0.999 ? Normalized(Cross(sun, {0.0, 0.0, 1.0})) : Vec3{1.0, 0.0, 0.0};
  const Vec3 upwards = Cross(across, sun);
  double sum = 0.0;
  for (int i = 0; i < kSunDiscRays; ++i) {
    const Vec2 in_disc = InUnitDisc(i) * sky::kSolarRadiusAt1Au;
    const Vec3 offset = across * in_disc.x + upwards * in_disc.y;
    double depth = 0.0;
    for (const auto& field : fields) {
      const CloudLayer& layer = field->layer();
      const double middle = layer.base_m + 0.5 * layer.thickness_m - point_m.z;
      const double distance = std::max(0.0, middle / sun.z);
      // Along the ground: a shift upwards is one towards the sun.
      const Vec3 shift = offset * distance;
      const Vec3 level = shift - sun * (shift.z / sun.z);
      depth += field->DepthAlong(point_m + level, sun, seconds);
    }
    sum += std::exp(-depth);
  }
  return sum / kSunDiscRays;
}

double PointSunTransmittance(const CloudFields& fields, Vec3 point_m, Direction<World> to_sun,
                             double seconds) {
  if (to_sun.xyz.z <= 0.0) return 0.0;
  double depth = 0.0;
  for (const auto& field : fields) depth += field->DepthAlong(point_m, to_sun.xyz, seconds);
  return std::exp(-depth);
}

}  // namespace pleinair::clouds
