#include "compositor/light/phantom_paths.h"

#include <array>
#include <numbers>

#include "compositor/light/patch_scene.h"

namespace pleinair::compositor {
namespace {

SamplePoint RandomPoint(std::uint32_t seed, std::uint32_t salt) {
  return {UnitFromHash(Hash(seed, salt)), UnitFromHash(Hash(seed, salt + 1))};
}

}  // namespace

PhantomPaths::PhantomPaths(const PatchScene& scene, int bounces, const sky::SkyModel& day,
                           const Mat3& marker_from_world,
                           const SunTransmittanceMap& sun_transmittance)
    : scene_(scene),
      bounces_(bounces),
      sky_(day, marker_from_world, kLandAlbedo),
      sun_frame_(marker_from_world * day.ToSun().xyz),
      sun_(day.SunNormalIrradiance()),
      sun_transmittance_(sun_transmittance) {}

LinearRgb PhantomPaths::Irradiance(Vec3 point, const TangentFrame& frame,
                                   std::uint32_t paths) const {
  const bool has_sun = Luminance(sun_) > 0.0;
  LinearRgb sum;
  for (std::uint32_t path = 0; path < paths; ++path) {
    Vec3 origin = point + frame.normal * kRayOffset_m;
    Vec3 direction = CosineDirection(frame, ShiftedHammersley(path, paths, 0));
    LinearRgb throughput{1.0, 1.0, 1.0};
    for (int bounce = 0;; ++bounce) {
      RayHit hit;
      if (!scene_.rays->Intersect(RayTargets::kPhantoms, origin, direction, &hit)) {
        const std::array<float, 3> radiance = sky_.Radiance(direction);
        sum = sum + throughput * LinearRgb{radiance[0], radiance[1], radiance[2]};
        break;
      }
      const PatchScene::Face& face = scene_.FaceOf(hit);
      if (bounce == bounces_ || (hit.back && face.back_offset == 0)) break;
      const auto& albedo = scene_.mesh_sides[face.mesh_side].albedo;
      throughput = throughput * LinearRgb{albedo[0], albedo[1], albedo[2]};
      const TangentFrame at_hit(hit.back ? -face.normal : face.normal);
      origin = origin + direction * hit.distance_m + at_hit.normal * kRayOffset_m;
      const std::uint32_t seed = Hash(path, static_cast<std::uint32_t>(bounce));
      const double cosine = has_sun ? Dot(at_hit.normal, sun_frame_.normal) : 0.0;
      const Vec3 to_sun = SunDiscDirection(sun_frame_, RandomPoint(seed, 1));
      if (cosine > 0.0 && !scene_.rays->Occluded(RayTargets::kPhantoms, origin, to_sun)) {
        sum = sum + throughput * sun_ * (sun_transmittance_.At(origin) * cosine / std::numbers::pi);
      }
      direction = CosineDirection(at_hit, RandomPoint(seed, 3));
    }
  }
  return sum * (std::numbers::pi / paths);
}

}  // namespace pleinair::compositor
