#include "compositor/light/phantom_rays.h"

#include <cstddef>

#include "base/parallel_for.h"
#include "compositor/light/light_solver_options.h"
#include "compositor/light/patch_scene.h"
#include "compositor/light/phantom_paths.h"
#include "compositor/light/sampling.h"
#include "compositor/light/sun_transmittance_map.h"

namespace pleinair::compositor {
namespace {

constexpr std::uint32_t kSunRays = 256;

class EmbreePhantomRays : public PhantomRays {
 public:
  EmbreePhantomRays(const PatchScene& scene, int bounces, int threads)
      : scene_(scene), bounces_(bounces), threads_(threads) {}

  double SunVisibility(Point<Marker> point, Vec3 to_sun_in_marker) const override {
    const TangentFrame frame(Normalized(to_sun_in_marker));
    const Vec3 origin = point.xyz + frame.normal * kRayOffset_m;
    std::uint32_t visible = 0;
    for (std::uint32_t i = 0; i < kSunRays; ++i) {
      const Vec3 direction = SunDiscDirection(frame, ShiftedHammersley(i, kSunRays, 0));
      if (!scene_.rays->Occluded(RayTargets::kPhantoms, origin, direction)) ++visible;
    }
    return static_cast<double>(visible) / kSunRays;
  }

  bool IsUnoccluded(Point<Marker> point, Vec3 direction) const override {
    return !scene_.rays->Occluded(RayTargets::kPhantoms, point.xyz + direction * kRayOffset_m,
                                  direction);
  }

  std::optional<PhantomSurface> First(Point<Marker> eye, Vec3 direction) const override {
    RayHit hit, leaf;
    const bool found = scene_.rays->Intersect(RayTargets::kPhantoms, eye.xyz, direction, &hit);
    if (scene_.foliage != nullptr &&
        scene_.foliage->Intersect(RayTargets::kPhantoms, eye.xyz, direction, &leaf) &&
        (!found || leaf.distance_m < hit.distance_m)) {
      PhantomSurface surface;
      surface.point = {eye.xyz + direction * leaf.distance_m};
      surface.is_foliage = true;
      return surface;
    }
    if (!found) return {};
    const PatchScene::Face& face = scene_.FaceOf(hit);
    const int side = hit.back ? 1 : 0;
    const PatchScene::MeshSide& mesh_side = scene_.mesh_sides[face.mesh_side];
    const auto& albedo = mesh_side.albedo;
    return PhantomSurface{{eye.xyz + direction * hit.distance_m},
                          hit.back ? -face.normal : face.normal,
                          static_cast<int>(face.mesh_side) * 2 + side,
                          {albedo[0], albedo[1], albedo[2]},
                          false,
                          mesh_side.mesh.placed_model};
  }

  using PhantomRays::Ambient;
  std::vector<LinearRgb> Ambient(std::span<const FacingPoint> points, const sky::SkyModel& daylight,
                                 const Mat3& marker_from_world,
                                 std::uint32_t paths) const override {
    const SunTransmittanceMap no_trees;
    const PhantomPaths tracer(scene_, bounces_, daylight, marker_from_world, no_trees);
    std::vector<LinearRgb> ambient(points.size());
    ParallelFor(points.size(), threads_, [&](std::size_t i) {
      const TangentFrame frame(Normalized(points[i].normal));
      ambient[i] = tracer.Irradiance(points[i].point.xyz, frame, paths);
    });
    return ambient;
  }

 private:
  const PatchScene& scene_;
  int bounces_, threads_;
};

}  // namespace

std::unique_ptr<const PhantomRays> MakePhantomRays(const PatchScene& scene,
                                                   const LightSolverOptions& options) {
  return std::make_unique<EmbreePhantomRays>(scene, options.bounces, options.threads);
}

}  // namespace pleinair::compositor
