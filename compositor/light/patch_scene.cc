#include "compositor/light/patch_scene.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "compositor/light/foliage.h"
#include "compositor/light/gather_origin.h"
#include "compositor/light/light_refinement.h"
#include "compositor/light/light_solver_options.h"
#include "compositor/light/reflectance.h"
#include "compositor/light/tessellation.h"
#include "compositor/models/model.h"
#include "compositor/models/placed_model.h"

namespace pleinair::compositor {
namespace {

// Hit records keep a face's index in 26 bits.
constexpr std::size_t kMaxFaces = std::size_t{1} << 26;

Vec3 ToVec3(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

Result<void> CheckModel(const PlacedModel& placed) {
  if (placed.model == nullptr) return InputError("scene", "a placed model is missing");
  const std::string file = placed.model->file.string();
  for (const double value : placed.linear.m) {
    if (!std::isfinite(value)) return InputError(file, "the model's placement is not finite");
  }
  for (const Mesh& mesh : placed.model->meshes) {
    const std::size_t count = mesh.positions.size();
    if (!mesh.uvs.empty() && mesh.uvs.size() != count) {
      return InputError(file, "mesh \"" + mesh.name + "\" has too few texture coordinates");
    }
    if (!mesh.details.empty() && mesh.details.size() != count) {
      return InputError(file, "mesh \"" + mesh.name + "\" has too few colors of vertices");
    }
    for (const std::uint32_t index : mesh.indices) {
      if (index >= count) return InputError(file, "mesh \"" + mesh.name + "\" lacks a vertex");
    }
  }
  return {};
}

/// The file of the model with the most triangles, for errors about too many or none.
std::string LargestModel(const std::vector<PlacedModel>& models) {
  std::string file = "scene";
  std::size_t maximum = 0;
  for (const PlacedModel& placed : models) {
    std::size_t size = 1;
    for (const Mesh& mesh : placed.model->meshes) size += mesh.indices.size();
    if (size > maximum) file = placed.model->file.string();
    maximum = std::max(maximum, size);
  }
  return file;
}

SurfaceMesh OtherSide(const SurfaceMesh& mesh) {
  SurfaceMesh other = mesh;
  for (auto& normal : other.normals) {
    for (float& value : normal) value = -value;
  }
  for (std::size_t i = 0; i + 2 < other.indices.size(); i += 3) {
    std::swap(other.indices[i + 1], other.indices[i + 2]);
  }
  return other;
}

std::vector<Vec3> GatherOrigins(const SurfaceMesh& mesh) {
  const std::vector<Vec3> centres = CentresAround(mesh);
  std::vector<Vec3> origins;
  origins.reserve(mesh.positions.size());
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    origins.push_back(GatherOrigin(SurfacePointAt(mesh, v), centres[v]));
  }
  return origins;
}

/// Max. surface samples of a patch: an even selection of its many vertices suffices.
constexpr std::uint32_t kMaxSurfaceSamples = 64;

void AddSurfaceSamples(const PatchScene::MeshSide& mesh_side, PatchScene* scene) {
  const std::vector<Vec3> origins = GatherOrigins(mesh_side.mesh);
  const auto add = [&](std::uint32_t vertex) {
    scene->surface_samples.push_back({origins[vertex], mesh_side.mesh.normals[vertex]});
  };
  if (!mesh_side.groups) {
    for (std::uint32_t vertex = 0; vertex < origins.size(); ++vertex) {
      add(vertex);
      scene->surface_sample_ends.push_back(
          static_cast<std::uint32_t>(scene->surface_samples.size()));
    }
    return;
  }
  std::uint32_t first = 0;
  for (const std::uint32_t last : mesh_side.groups->member_ends) {
    const std::uint32_t size = last - first;
    const std::uint32_t count = std::min(size, kMaxSurfaceSamples);
    for (std::uint64_t i = 0; i < count; ++i) {
      add(mesh_side.groups->members[first + static_cast<std::uint32_t>(i * size / count)]);
    }
    scene->surface_sample_ends.push_back(static_cast<std::uint32_t>(scene->surface_samples.size()));
    first = last;
  }
}

/// Light that a mesh side sends on.
struct SideOptics {
  std::array<float, 3> albedo{}, transmittance{};
};

void AddSheet(SurfaceMesh mesh, const SideOptics& optics,
              std::shared_ptr<const SurfacePatches> groups, PatchScene* scene) {
  PatchScene::MeshSide mesh_side;
  mesh_side.albedo = optics.albedo;
  mesh_side.transmittance = optics.transmittance;
  mesh_side.first_patch = scene->patch_count;
  mesh_side.patch_count =
      groups ? groups->count : static_cast<std::uint32_t>(mesh.positions.size());
  mesh_side.groups = std::move(groups);
  mesh_side.mesh = std::move(mesh);
  scene->patch_count += mesh_side.patch_count;
  AddSurfaceSamples(mesh_side, scene);
  scene->mesh_sides.push_back(std::move(mesh_side));
}

/// `indices`: the triangles that rays hit. Their corners are vertices of the mesh.
void AddFaces(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& indices,
              const SurfacePatches* groups, std::uint32_t mesh_side, PatchScene* scene) {
  const std::uint32_t base = scene->patch_count;
  const auto size =
      groups != nullptr ? groups->count : static_cast<std::uint32_t>(mesh.positions.size());
  scene->first_face.push_back(static_cast<std::uint32_t>(scene->faces.size()));
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    PatchScene::Face face;
    std::array<Vec3, 3> p;
    for (int c = 0; c < 3; ++c) {
      p[c] = ToVec3(mesh.positions[indices[i + c]]);
      const std::uint32_t vertex = indices[i + c];
      face.patches[c] = base + (groups != nullptr ? groups->patch_of[vertex] : vertex);
    }
    face.back_offset = mesh.closed ? 0 : size;
    face.mesh_side = mesh_side;
    const Vec3 normal = Cross(p[1] - p[0], p[2] - p[0]);
    const double norm = Norm(normal);
    face.normal = norm > 0.0 ? normal * (1.0 / norm) : ToVec3(mesh.normals[indices[i]]);
    scene->faces.push_back(face);
  }
}

/// Two corners of the box around all shapes of an object that changes, in place of its surfaces.
SurfaceMesh BoxAroundShapes(const PlacedModel& placed) {
  const auto [low, high] = BoundsOfShapes(placed);
  SurfaceMesh box;
  for (const Vec3 at : {low, high}) {
    box.positions.push_back(
        {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)});
  }
  return box;
}

}  // namespace

std::vector<std::array<float, 3>> PatchScene::VertexLight(
    const MeshSide& mesh_side, std::span<const std::array<float, 3>> patch_light) const {
  const auto of_sheet = patch_light.subspan(mesh_side.first_patch, mesh_side.patch_count);
  if (mesh_side.groups) return mesh_side.groups->Interpolate(of_sheet);
  return {of_sheet.begin(), of_sheet.end()};
}

Result<PatchScene> PatchScene::Create(const std::vector<PlacedModel>& models,
                                      const LightSolverOptions& options) {
  std::vector<SurfaceMesh> surfaces, boxes;
  for (std::size_t i = 0; i < models.size(); ++i) {
    PLEINAIR_RETURN_IF_ERROR(CheckModel(models[i]));
    if (models[i].playback.animation) {
      boxes.push_back(BoxAroundShapes(models[i]));
      continue;
    }
    for (SurfaceMesh& surface : OrientedSurfaces(models[i], static_cast<int>(i))) {
      // The render-only geometry of phantoms is never drawn.
      if (surface.is_phantom && surface.role == MeshRole::kRenderOnly) continue;
      if (surface.is_phantom) {
        surface.role = MeshRole::kAll;
        if (auto leaves = ExtractFoliage(&surface)) {
          leaves->role = MeshRole::kRenderOnly;
          surfaces.push_back(*std::move(leaves));
        }
      }
      if (!surface.indices.empty()) surfaces.push_back(std::move(surface));
    }
  }
  if (surfaces.empty()) {
    return InputError(LargestModel(models), "has no surface to light",
                      boxes.empty() ? "give at least one phantom or object with triangles"
                                    : "add [ground] or a phantom below the animation");
  }
  TessellationOptions tessellation;
  tessellation.near_edge_m = options.near_edge_m;
  tessellation.growth_per_m = options.growth_per_m;
  std::size_t vertices = 0;
  for (const SurfaceMesh& surface : surfaces) vertices += surface.positions.size();
  // Surfaces that are already fine must not keep others from being subdivided.
  if (vertices > options.max_patches) tessellation.max_vertices += vertices;
  surfaces.insert(surfaces.end(), boxes.begin(), boxes.end());
  Tessellate(tessellation, &surfaces);
  surfaces.resize(surfaces.size() - boxes.size());
  PatchScene scene;
  for (const SurfaceMesh& box : boxes) {
    scene.changing_middles.push_back((ToVec3(box.positions[0]) + ToVec3(box.positions[1])) * 0.5);
  }
  std::vector<RayMesh> ray_meshes, leaf_meshes;
  std::vector<SurfaceOfRays> surfaces_of_rays;
  for (std::uint32_t i = 0; i < surfaces.size(); ++i) {
    const SurfaceMesh& surface = surfaces[i];
    const RayMesh mesh{surface.positions, surface.indices, surface.is_phantom};
    if (surface.role != MeshRole::kRenderOnly) {
      surfaces_of_rays.push_back({i, surface.closed});
      ray_meshes.push_back(mesh);
    } else if (surface.is_phantom) {
      leaf_meshes.push_back(mesh);
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(scene.rays, RayScene::Create(ray_meshes, LargestModel(models)));
  const std::vector<LightPlaces> light_places = RefineForLight(
      *scene.rays, surfaces_of_rays, options.near_edge_m, options.threads, &surfaces);
  std::vector<SurfacePatches> divided(surfaces.size());
  if (options.share_dense) {
    divided = DividedWhereDense(surfaces, light_places, options.threads);
  }
  if (PatchCount(surfaces, divided) > options.max_patches) {
    divided = DividedIntoPatches(surfaces, tessellation, options.max_patches, options.threads);
  }
  std::size_t next_ray_mesh = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    SurfaceMesh& surface = surfaces[i];
    std::shared_ptr<const SurfacePatches> groups;
    if (divided[i].count > 0) {
      groups = std::make_shared<const SurfacePatches>(std::move(divided[i]));
    }
    const PlacedModel& placed = models[surface.placed_model];
    SideOptics optics{ReflectanceOf(*placed.model, surface.material), {}};
    const bool closed = surface.closed;
    if (!closed) {
      optics.transmittance = TransmittanceOf(placed, surface.material, optics.albedo);
    }
    const std::array<float, 3> mean_color = MeanVertexColor(surface);
    for (int c = 0; c < 3; ++c) optics.albedo[c] *= mean_color[c];
    const auto front = static_cast<int>(scene.mesh_sides.size());
    if (surface.role != MeshRole::kRenderOnly) {
      AddFaces(surface, ray_meshes[next_ray_mesh++].indices, groups.get(),
               static_cast<std::uint32_t>(front), &scene);
    }
    SurfaceMesh back = closed ? SurfaceMesh{} : OtherSide(surface);
    AddSheet(std::move(surface), optics, groups, &scene);
    if (!closed) {
      AddSheet(std::move(back), optics, groups, &scene);
      scene.mesh_sides[front].twin = front + 1;
      scene.mesh_sides[front + 1].twin = front;
    }
  }
  if (scene.faces.size() >= kMaxFaces) {
    return InputError(LargestModel(models),
                      "with the scene's other models it has more than 67 million triangles, "
                      "subdivided for the light",
                      "use simpler models");
  }
  if (!leaf_meshes.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(scene.foliage, RayScene::Create(leaf_meshes, LargestModel(models)));
  }
  return scene;
}

}  // namespace pleinair::compositor
