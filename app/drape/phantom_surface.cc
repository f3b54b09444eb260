#include "app/drape/phantom_surface.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "compositor/models/placed_model.h"
#include "scene/marker_heading.h"
#include "session/scene_renderer.h"

namespace pleinair::app {
namespace {

/// Adds the triangles of one phantom.
void AddPhantom(const compositor::PlacedModel& placed, std::uint32_t surface,
                const Mat3& world_from_marker, content::SurfaceMesh* mesh) {
  for (const compositor::Mesh& part : placed.model->meshes) {
    // Of a surface with holes, the mesh with the holes cut out counts.
    if (part.role == compositor::MeshRole::kRenderOnly) continue;
    const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
    for (const auto& [x, y, z] : part.positions) {
      const Vec3 in_model = Vec3{x, y, z} + placed.model->origin_m;
      const Vec3 in_marker = placed.linear * in_model + placed.translation_m;
      mesh->vertices.push_back({world_from_marker * in_marker});
    }
    for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
      mesh->triangles.push_back(
          {first + part.indices[i], first + part.indices[i + 1], first + part.indices[i + 2]});
      mesh->surfaces.push_back(surface);
    }
  }
}

}  // namespace

Result<content::SurfaceIndex> SurfaceOfPhantoms(
    const std::vector<compositor::PlacedModel>& phantoms, const Mat3& marker_from_world) {
  content::SurfaceMesh mesh;
  const Mat3 world_from_marker = marker_from_world.Transposed();
  std::uint32_t surface = 0;
  for (const compositor::PlacedModel& placed : phantoms) {
    if (placed.is_phantom) AddPhantom(placed, surface++, world_from_marker, &mesh);
  }
  return content::SurfaceIndex::Create(std::move(mesh));
}

Result<content::SurfaceIndex> SurfaceOfScene(const scene::SceneDescription& scene) {
  std::vector<compositor::PlacedModel> phantoms;
  for (const scene::ModelReference& reference : scene.phantoms) {
    PLEINAIR_ASSIGN_OR_RETURN(compositor::PlacedModel placed,
                              session::PlaceModel(reference, true, scene.marker));
    phantoms.push_back(std::move(placed));
  }
  return SurfaceOfPhantoms(phantoms, scene::MarkerFromWorld(scene.marker));
}

content::SurfaceRule RuleOf(const scene::DrapeDescription& drape,
                            const scene::SceneDescription& scene) {
  if (drape.on == scene::kOnTop) return {content::SurfaceChoice::kTop, 0};
  if (drape.on == scene::kOnLowest) return {content::SurfaceChoice::kLowest, 0};
  const std::vector<std::string> names = scene::NamesOfPhantoms(scene);
  const auto found = std::find(names.begin(), names.end(), drape.on);
  return {content::SurfaceChoice::kNamed, static_cast<std::uint32_t>(found - names.begin())};
}

}  // namespace pleinair::app
