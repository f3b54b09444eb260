#include "compositor/light/light_solver.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include "compositor/light/final_gather.h"
#include "compositor/light/patch_scene.h"
#include "compositor/light/phantom_paths.h"
#include "compositor/light/radiosity.h"
#include "compositor/light/sampling.h"
#include "compositor/light/scaled_sky.h"
#include "compositor/light/sky_table.h"
#include "compositor/light/sun_visibility.h"

namespace pleinair::compositor {
namespace {

// Takes about five seconds on two processors.
constexpr std::uint32_t kRayBudget = 25'000'000;
constexpr std::uint32_t kMinRays = 32;

constexpr std::size_t kSkySeenPatches = 64;
// Max. number of phantom triangles whose sun visibility is computed: up to a second of ray tracing.
constexpr std::size_t kMaxVisited = 200'000;

int RaysPerPatch(const PatchScene& scene, const LightSolverOptions& options) {
  const std::uint32_t affordable = kRayBudget / std::max(1U, scene.patch_count);
  const auto wanted = static_cast<std::uint32_t>(std::max(1, options.rays_per_vertex));
  return static_cast<int>(std::min(wanted, std::max(kMinRays, affordable)));
}

/// The centres of the virtual objects' bounding boxes.
std::vector<Vec3> ObjectMiddles(const PatchScene& scene) {
  struct Box {
    Vec3 low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
  };
  std::map<int, Box> boxes;
  for (const PatchScene::MeshSide& mesh_side : scene.mesh_sides) {
    if (mesh_side.mesh.is_phantom) continue;
    Box& box = boxes[mesh_side.mesh.placed_model];
    for (const auto& [x, y, z] : mesh_side.mesh.positions) {
      box.low = {std::min<double>(box.low.x, x), std::min<double>(box.low.y, y),
                 std::min<double>(box.low.z, z)};
      box.high = {std::max<double>(box.high.x, x), std::max<double>(box.high.y, y),
                  std::max<double>(box.high.z, z)};
    }
  }
  std::vector<Vec3> middles = scene.changing_middles;
  for (const auto& [model, box] : boxes) middles.push_back((box.low + box.high) * 0.5);
  return middles;
}

struct Run {
  std::size_t first = 0, count = 0;
};
/// The phantoms' patches as the smallest number of contiguous runs.
std::vector<Run> PhantomPatches(const PatchScene& scene) {
  std::vector<Run> runs;
  for (const PatchScene::MeshSide& mesh_side : scene.mesh_sides) {
    if (!mesh_side.mesh.is_phantom) continue;
    if (runs.empty() || runs.back().first + runs.back().count != mesh_side.first_patch) {
      runs.push_back({mesh_side.first_patch, 0});
    }
    runs.back().count += mesh_side.patch_count;
  }
  return runs;
}

LitMesh MakeLitMesh(const PatchScene& scene, const PatchScene::MeshSide& mesh_side,
                    std::uint64_t first_geometry, const PatchLight& light) {
  LitMesh mesh;
  mesh.is_phantom = mesh_side.mesh.is_phantom;
  mesh.placed_model = mesh_side.mesh.placed_model;
  mesh.material = mesh_side.mesh.material;
  const auto index = static_cast<int>(&mesh_side - scene.mesh_sides.data());
  mesh.geometry = first_geometry + static_cast<std::uint64_t>(index);
  mesh.role = mesh_side.mesh.role;
  mesh.positions = mesh_side.mesh.positions;
  mesh.normals = mesh_side.mesh.normals;
  mesh.texturing = {mesh_side.mesh.uvs, mesh_side.mesh.details,
                    mesh_side.twin >= 0 && mesh_side.twin < index, mesh_side.albedo,
                    mesh_side.transmittance};
  mesh.indices = mesh_side.mesh.indices;
  mesh.ambient_with = scene.VertexLight(mesh_side, light.irradiance[0]);
  mesh.sunlight.reflected_with = scene.VertexLight(mesh_side, light.reflected[0]);
  if (mesh.is_phantom) {
    mesh.ambient_without = scene.VertexLight(mesh_side, light.irradiance[1]);
    mesh.sunlight.reflected_without = scene.VertexLight(mesh_side, light.reflected[1]);
  } else if (mesh_side.twin >= 0 && mesh_side.transmittance != std::array<float, 3>{}) {
    // Both sides have the same vertices in the same order.
    const PatchScene::MeshSide& behind = scene.mesh_sides[mesh_side.twin];
    mesh.ambient_without = scene.VertexLight(behind, light.irradiance[0]);
    mesh.sunlight.reflected_without = scene.VertexLight(behind, light.reflected[0]);
  } else {
    mesh.sunlight.lifts = OutwardLifts(mesh_side.mesh);
  }
  return mesh;
}

/// The side of an open surface with the larger `sky_seen` comes first.
template <typename SkySeen>
std::vector<LitMesh> MakeLitMeshes(const PatchScene& scene, std::uint64_t first_geometry,
                                   const PatchLight& light, const SkySeen& sky_seen) {
  std::vector<LitMesh> meshes;
  for (std::size_t i = 0; i < scene.mesh_sides.size(); ++i) {
    const int twin = scene.mesh_sides[i].twin;
    if (twin >= 0 && static_cast<std::size_t>(twin) < i) continue;
    meshes.push_back(MakeLitMesh(scene, scene.mesh_sides[i], first_geometry, light));
    if (twin < 0) continue;
    meshes.push_back(MakeLitMesh(scene, scene.mesh_sides[twin], first_geometry, light));
    if (sky_seen(scene.mesh_sides[twin]) > sky_seen(scene.mesh_sides[i])) {
      std::swap(meshes.back(), meshes[meshes.size() - 2]);
    }
  }
  return meshes;
}

}  // namespace

Result<std::unique_ptr<LightSolver>> LightSolver::Create(const std::vector<PlacedModel>& scene,
                                                         const LightSolverOptions& options) {
  PLEINAIR_ASSIGN_OR_RETURN(PatchScene light_scene, PatchScene::Create(scene, options));
  return std::unique_ptr<LightSolver>(new LightSolver(std::move(light_scene), options));
}

LightSolver::LightSolver(PatchScene scene, const LightSolverOptions& options)
    : options_(options),
      scene_(std::make_shared<const PatchScene>(std::move(scene))),
      phantoms_(MakePhantomRays(*scene_, options)) {
  static std::atomic<std::uint64_t> mesh_sides{0};
  first_geometry_ = 1 + mesh_sides.fetch_add(scene_->mesh_sides.size());
}

LightSolver::~LightSolver() = default;

std::unique_ptr<LightSolver> LightSolver::WithRays(int rays_per_vertex) const {
  std::unique_ptr<LightSolver> solver(new LightSolver(*this));
  solver->options_.rays_per_vertex = rays_per_vertex;
  return solver;
}

std::vector<LitMesh> LightSolver::SolveUnderTrees(
    const sky::SkyModel& daylight, const Mat3& marker_from_world,
    const SunTransmittanceMap& sun_transmittance) const {
  const SkyTable sky(daylight, marker_from_world, kLandAlbedo);
  const Vec3 to_sun = marker_from_world * daylight.ToSun().xyz;
  const LinearRgb sun = daylight.SunNormalIrradiance();
  const FinalGather gathered = Gather(*scene_, sky, to_sun, sun_transmittance,
                                      RaysPerPatch(*scene_, options_), options_.threads);
  const PatchLight light = SolveRadiosity(
      *scene_, gathered,
      {static_cast<float>(sun.r), static_cast<float>(sun.g), static_cast<float>(sun.b)}, to_sun,
      options_.bounces, options_.threads);
  std::vector<LitMesh> meshes =
      MakeLitMeshes(*scene_, first_geometry_, light, [&](const PatchScene::MeshSide& mesh_side) {
        double rays = 0.0;
        for (std::size_t i = 0; i < mesh_side.patch_count; ++i) {
          rays += gathered.patches[mesh_side.first_patch + i].sky_rays[0];
        }
        return rays;
      });
  // Without a sun, sun visibility is not needed.
  std::size_t left = Luminance(sun) > 0.0 ? kMaxVisited : 0;
  for (LitMesh& mesh : meshes) {
    if (mesh.is_phantom && mesh.indices.size() / 3 <= left) {
      left -= mesh.indices.size() / 3;
      mesh.sunlight.by_triangle =
          ClassifySunVisibility(*scene_->rays, mesh, to_sun, options_.threads);
      mesh.sunlight.to_sun = {static_cast<float>(to_sun.x), static_cast<float>(to_sun.y),
                              static_cast<float>(to_sun.z)};
    }
  }
  return meshes;
}

DaylightCoefficients LightSolver::Coefficients(Vec3 up, const CoefficientOptions& options,
                                               const CoefficientProgress& progress) const {
  const std::uint64_t hash = GeometryHash(*scene_, up, options);
  if (!options.cache.empty()) {
    auto found = ReadCoefficients(options.cache, hash);
    if (found && found->with.vertices() == scene_->patch_count) return *std::move(found);
  }
  DaylightCoefficients computed = ComputeCoefficients(*scene_, up, options, progress);
  const bool stopped = options.stop != nullptr && *options.stop;
  if (!options.cache.empty() && !stopped) {
    computed.kept = WriteCoefficients(options.cache, hash, computed);
  }
  return computed;
}

std::vector<LitMesh> LightSolver::Relight(const DaylightCoefficients& coefficients,
                                          const sky::SkyModel& daylight,
                                          const Mat3& marker_from_world) const {
  const SkyPatches patches = coefficients.Patches();
  const auto sky = patches.Radiances(daylight, marker_from_world, kLandAlbedo);
  const auto sun = patches.Sun(daylight, marker_from_world);
  PatchLight light;
  const auto sunlit_land =
      patches.Radiances(ScaledSky(daylight, {}, {1.0, 1.0, 1.0}), marker_from_world, kLandAlbedo);
  const auto multiply = [&](std::span<const LinearRgb> of_sky,
                            std::array<std::vector<std::array<float, 3>>, 2>* irradiance) {
    for (auto& values : *irradiance) values.resize(scene_->patch_count);
    coefficients.with.Multiply(of_sky, sun, (*irradiance)[0]);
    // Virtual objects have no light in the case without them.
    for (const auto& [first, count] : PhantomPatches(*scene_)) {
      coefficients.without.Multiply(of_sky, sun, std::span((*irradiance)[1]).subspan(first, count),
                                    first);
    }
  };
  multiply(sky, &light.irradiance);
  multiply(sunlit_land, &light.reflected);
  return MakeLitMeshes(*scene_, first_geometry_, light, [&](const PatchScene::MeshSide& mesh_side) {
    // A subset of the patches suffices to find the side that faces the sky.
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

LinearRgb LightSolver::RadianceFromBelow(const sky::SkyModel& daylight,
                                         const Mat3& marker_from_world,
                                         const SunTransmittanceMap& sun_transmittance) const {
  const std::vector<Vec3> middles = ObjectMiddles(*scene_);
  if (middles.empty()) return {};
  const PhantomPaths tracer(*scene_, options_.bounces, daylight, marker_from_world,
                            sun_transmittance);
  const TangentFrame down(marker_from_world * Vec3{0.0, 0.0, -1.0});
  LinearRgb irradiance;
  for (const Vec3 middle : middles) {
    irradiance = irradiance + tracer.Irradiance(middle, down, PhantomRays::kMarkerPaths);
  }
  return irradiance * (std::numbers::inv_pi / static_cast<double>(middles.size()));
}

}  // namespace pleinair::compositor
