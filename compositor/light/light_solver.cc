#include "compositor/light/light_solver.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include "base/parallel_for.h"
#include "compositor/light/final_gather.h"
#include "compositor/light/patch_scene.h"
#include "compositor/light/sampling.h"
#include "compositor/light/sky_table.h"
#include "compositor/light/sun_visibility.h"

namespace pleinair::compositor {
namespace {

// About five seconds on two processors.
constexpr std::uint32_t kRayBudget = 25'000'000;
constexpr std::uint32_t kMinRays = 32;

// Reflectance of the land beyond the phantoms; 0.2 is the customary value for mixed ground.
constexpr double kLandAlbedo = 0.2;

constexpr std::uint32_t kSunRays = 256;
constexpr std::size_t kSkySeenPatches = 64;
// Triangles of phantoms that are asked how much of the sun reaches them: up to a second's rays.
constexpr std::size_t kMaxVisited = 200'000;

class EmbreeLightSolver : public LightSolver {
 public:
  EmbreeLightSolver(PatchScene scene, const LightSolverOptions& options)
      : scene_(std::move(scene)), options_(options) {
    static std::atomic<std::uint64_t> mesh_sides{0};
    first_geometry_ = 1 + mesh_sides.fetch_add(scene_.mesh_sides.size());
  }

  std::vector<LitMesh> SolveUnderTrees(
      const sky::SkyModel& day, const Mat3& marker_from_world,
      const SunTransmittanceMap& sun_transmittance) const override {
    const SkyTable sky(day, marker_from_world, kLandAlbedo);
    const Vec3 to_sun = marker_from_world * day.ToSun().xyz;
    const LinearRgb sun = day.SunNormalIrradiance();
    const FinalGather gathered =
        Gather(scene_, sky, to_sun, sun_transmittance, RaysPerPatch(), options_.threads);
    const PatchLight light = SolveRadiosity(
        scene_, gathered,
        {static_cast<float>(sun.r), static_cast<float>(sun.g), static_cast<float>(sun.b)}, to_sun,
        options_.bounces, options_.threads);
    std::vector<LitMesh> meshes = MakeLitMeshes(light, [&](const PatchScene::MeshSide& mesh_side) {
      double rays = 0.0;
      for (std::size_t i = 0; i < mesh_side.patch_count; ++i) {
        rays += gathered.patches[mesh_side.first_patch + i].sky_rays[0];
      }
      return rays;
    });
    // Without a sun there is nothing to be asked.
    std::size_t left = Luminance(sun) > 0.0 ? kMaxVisited : 0;
    for (LitMesh& mesh : meshes) {
      if (mesh.is_phantom && mesh.indices.size() / 3 <= left) {
        left -= mesh.indices.size() / 3;
        mesh.sun_visibility = ClassifySunVisibility(*scene_.rays, mesh, to_sun, options_.threads);
        mesh.sun_visibility_to_sun = {static_cast<float>(to_sun.x), static_cast<float>(to_sun.y),
                                      static_cast<float>(to_sun.z)};
      }
    }
    return meshes;
  }

  DaylightCoefficients Coefficients(Vec3 up, const CoefficientOptions& options,
                                    const CoefficientProgress& progress) const override {
    const std::uint64_t hash = GeometryHash(scene_, up, options);
    if (!options.cache.empty()) {
      auto found = ReadCoefficients(options.cache, hash);
      if (found && found->with.vertices() == scene_.patch_count) return *std::move(found);
    }
    DaylightCoefficients computed = ComputeCoefficients(scene_, up, options, progress);
    const bool stopped = options.stop != nullptr && *options.stop;
    if (!options.cache.empty() && !stopped) {
      computed.kept = WriteCoefficients(options.cache, hash, computed);
    }
    return computed;
  }

  std::vector<LitMesh> Relight(const DaylightCoefficients& coefficients, const sky::SkyModel& day,
                               const Mat3& marker_from_world) const override {
    const SkyPatches patches = coefficients.Patches();
    const auto sky = patches.Radiances(day, marker_from_world, kLandAlbedo);
    const auto sun = patches.Sun(day, marker_from_world);
    PatchLight light;
    for (auto& irradiance : light.irradiance) irradiance.resize(scene_.patch_count);
    coefficients.with.Multiply(sky, sun, light.irradiance[0]);
    // Of the virtual objects there is no light without them.
    for (const auto& [first, count] : PhantomPatches()) {
      coefficients.without.Multiply(sky, sun, std::span(light.irradiance[1]).subspan(first, count),
                                    first);
    }
    return MakeLitMeshes(light, [&](const PatchScene::MeshSide& mesh_side) {
      // Some patches of a mesh side tell which side of it looks to the sky.
      const std::size_t size = mesh_side.patch_count;
      const std::size_t step = std::max<std::size_t>(1, size / kSkySeenPatches);
      double straight = 0.0;
      for (std::size_t i = 0; i < size; i += step) {
        for (int patch = 0; patch < patches.count(); ++patch) {
          straight += coefficients.with.At(mesh_side.first_patch + i, patch, 0);
        }
      }
      return straight;
    });
  }

  double SunVisibilityPhantomsOnly(Point<Marker> point, Vec3 to_sun_in_marker) const override {
    const TangentFrame frame(Normalized(to_sun_in_marker));
    const Vec3 origin = point.xyz + frame.normal * kRayOffset_m;
    std::uint32_t visible = 0;
    for (std::uint32_t i = 0; i < kSunRays; ++i) {
      const Vec3 direction = SunDiscDirection(frame, ShiftedHammersley(i, kSunRays, 0));
      if (!scene_.rays->Occluded(RayTargets::kPhantoms, origin, direction)) ++visible;
    }
    return static_cast<double>(visible) / kSunRays;
  }

  bool IsUnoccludedPhantomsOnly(Point<Marker> point, Vec3 direction) const override {
    return !scene_.rays->Occluded(RayTargets::kPhantoms, point.xyz + direction * kRayOffset_m,
                                  direction);
  }

  std::optional<PhantomSurface> FirstPhantom(Point<Marker> eye, Vec3 direction) const override {
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
    const auto& albedo = scene_.mesh_sides[face.mesh_side].albedo;
    return PhantomSurface{{eye.xyz + direction * hit.distance_m},
                          hit.back ? -face.normal : face.normal,
                          static_cast<int>(face.mesh_side) * 2 + side,
                          {albedo[0], albedo[1], albedo[2]},
                          false};
  }

  std::vector<LinearRgb> AmbientPhantomsOnly(std::span<const Point<Marker>> points, Vec3 normal,
                                             const sky::SkyModel& day,
                                             const Mat3& marker_from_world,
                                             std::uint32_t paths) const override {
    const SkyTable sky(day, marker_from_world, kLandAlbedo);
    const TangentFrame sun_frame(marker_from_world * day.ToSun().xyz);
    const TangentFrame frame(Normalized(normal));
    const LinearRgb sun = day.SunNormalIrradiance();
    std::vector<LinearRgb> ambient(points.size());
    ParallelFor(points.size(), options_.threads, [&](std::size_t i) {
      ambient[i] = FollowPaths(points[i].xyz, frame, sky, sun_frame, sun, {}, paths);
    });
    return ambient;
  }

  LinearRgb RadianceFromBelow(const sky::SkyModel& day, const Mat3& marker_from_world,
                              const SunTransmittanceMap& sun_transmittance) const override {
    const std::vector<Vec3> middles = ObjectMiddles();
    if (middles.empty()) return {};
    const SkyTable sky(day, marker_from_world, kLandAlbedo);
    const TangentFrame sun_frame(marker_from_world * day.ToSun().xyz);
    const TangentFrame down(marker_from_world * Vec3{0.0, 0.0, -1.0});
    LinearRgb irradiance;
    for (const Vec3 middle : middles) {
      irradiance = irradiance + FollowPaths(middle, down, sky, sun_frame, day.SunNormalIrradiance(),
                                            sun_transmittance, kMarkerPaths);
    }
    return irradiance * (std::numbers::inv_pi / static_cast<double>(middles.size()));
  }

 private:
  /// The middles of the boxes around the virtual objects.
  std::vector<Vec3> ObjectMiddles() const {
    struct Box {
      Vec3 low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
    };
    std::map<int, Box> boxes;
    for (const PatchScene::MeshSide& mesh_side : scene_.mesh_sides) {
      if (mesh_side.mesh.is_phantom) continue;
      Box& box = boxes[mesh_side.mesh.placed_model];
      for (const auto& [x, y, z] : mesh_side.mesh.positions) {
        box.low = {std::min<double>(box.low.x, x), std::min<double>(box.low.y, y),
                   std::min<double>(box.low.z, z)};
        box.high = {std::max<double>(box.high.x, x), std::max<double>(box.high.y, y),
                    std::max<double>(box.high.z, z)};
      }
    }
    std::vector<Vec3> middles;
    middles.reserve(boxes.size());
    for (const auto& [model, box] : boxes) middles.push_back((box.low + box.high) * 0.5);
    return middles;
  }

  /// Irradiance at a point whose surface has `frame`, by paths through the phantoms.
  LinearRgb FollowPaths(Vec3 point, const TangentFrame& frame, const SkyTable& sky,
                        const TangentFrame& sun_frame, LinearRgb sun,
                        const SunTransmittanceMap& sun_transmittance, std::uint32_t paths) const {
    LinearRgb sum;
    for (std::uint32_t path = 0; path < paths; ++path) {
      Vec3 origin = point + frame.normal * kRayOffset_m;
      Vec3 direction = CosineDirection(frame, ShiftedHammersley(path, paths, 0));
      LinearRgb throughput{1.0, 1.0, 1.0};
      for (int bounce = 0;; ++bounce) {
        RayHit hit;
        if (!scene_.rays->Intersect(RayTargets::kPhantoms, origin, direction, &hit)) {
          const std::array<float, 3> radiance = sky.Radiance(direction);
          sum = sum + throughput * LinearRgb{radiance[0], radiance[1], radiance[2]};
          break;
        }
        const PatchScene::Face& face = scene_.FaceOf(hit);
        if (bounce == options_.bounces || (hit.back && face.back_offset == 0)) break;
        const auto& albedo = scene_.mesh_sides[face.mesh_side].albedo;
        throughput = throughput * LinearRgb{albedo[0], albedo[1], albedo[2]};
        const TangentFrame at_hit(hit.back ? -face.normal : face.normal);
        origin = origin + direction * hit.distance_m + at_hit.normal * kRayOffset_m;
        const std::uint32_t seed = Hash(path, static_cast<std::uint32_t>(bounce));
        const double cosine = Dot(at_hit.normal, sun_frame.normal);
        const Vec3 to_sun = SunDiscDirection(sun_frame, RandomPoint(seed, 1));
        if (cosine > 0.0 && !scene_.rays->Occluded(RayTargets::kPhantoms, origin, to_sun)) {
          sum = sum + throughput * sun * (sun_transmittance.At(origin) * cosine / std::numbers::pi);
        }
        direction = CosineDirection(at_hit, RandomPoint(seed, 3));
      }
    }
    return sum * (std::numbers::pi / paths);
  }

  static SamplePoint RandomPoint(std::uint32_t seed, std::uint32_t salt) {
    return {UnitFromHash(Hash(seed, salt)), UnitFromHash(Hash(seed, salt + 1))};
  }

  int RaysPerPatch() const {
    const std::uint32_t affordable = kRayBudget / std::max(1U, scene_.patch_count);
    const auto wanted = static_cast<std::uint32_t>(std::max(1, options_.rays_per_vertex));
    return static_cast<int>(std::min(wanted, std::max(kMinRays, affordable)));
  }

  struct Run {
    std::size_t first = 0, count = 0;
  };
  /// The phantoms' patches, as few runs of them as can be.
  std::vector<Run> PhantomPatches() const {
    std::vector<Run> runs;
    for (const PatchScene::MeshSide& mesh_side : scene_.mesh_sides) {
      if (!mesh_side.mesh.is_phantom) continue;
      if (runs.empty() || runs.back().first + runs.back().count != mesh_side.first_patch) {
        runs.push_back({mesh_side.first_patch, 0});
      }
      runs.back().count += mesh_side.patch_count;
    }
    return runs;
  }

  /// Of an open surface's two sides, that of which `sky_seen` says more comes first.
  template <typename SkySeen>
  std::vector<LitMesh> MakeLitMeshes(const PatchLight& light, const SkySeen& sky_seen) const {
    std::vector<LitMesh> meshes;
    for (std::size_t i = 0; i < scene_.mesh_sides.size(); ++i) {
      const int twin = scene_.mesh_sides[i].twin;
      if (twin >= 0 && static_cast<std::size_t>(twin) < i) continue;
      meshes.push_back(MakeLitMesh(scene_.mesh_sides[i], light));
      if (twin < 0) continue;
      meshes.push_back(MakeLitMesh(scene_.mesh_sides[twin], light));
      if (sky_seen(scene_.mesh_sides[twin]) > sky_seen(scene_.mesh_sides[i])) {
        std::swap(meshes.back(), meshes[meshes.size() - 2]);
      }
    }
    return meshes;
  }

  LitMesh MakeLitMesh(const PatchScene::MeshSide& mesh_side, const PatchLight& light) const {
    LitMesh mesh;
    mesh.is_phantom = mesh_side.mesh.is_phantom;
    mesh.placed_model = mesh_side.mesh.placed_model;
    mesh.material = mesh_side.mesh.material;
    mesh.geometry =
        first_geometry_ + static_cast<std::uint64_t>(&mesh_side - scene_.mesh_sides.data());
    mesh.role = mesh_side.mesh.role;
    mesh.positions = mesh_side.mesh.positions;
    mesh.normals = mesh_side.mesh.normals;
    mesh.uvs = mesh_side.mesh.uvs;
    mesh.indices = mesh_side.mesh.indices;
    mesh.ambient_with = scene_.VertexLight(mesh_side, light.irradiance[0]);
    if (mesh.is_phantom) mesh.ambient_without = scene_.VertexLight(mesh_side, light.irradiance[1]);
    return mesh;
  }

  PatchScene scene_;
  LightSolverOptions options_;
  std::uint64_t first_geometry_ =
      0;  // LitMesh::geometry of the first mesh side; the others follow.
};

}  // namespace

Result<std::unique_ptr<LightSolver>> LightSolver::Create(const std::vector<PlacedModel>& scene,
                                                         const LightSolverOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(PatchScene light_scene, PatchScene::Create(scene, options));
  return std::make_unique<EmbreeLightSolver>(std::move(light_scene), options);
}

}  // namespace pleinair::compositor
