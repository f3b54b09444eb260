#include "compositor/surfaces/scene_surfaces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace pleinair::compositor {

namespace {

/// Whether a material does not cover all that it is drawn on.
bool IsSeenThrough(const Model& model, const Material& material) {
  if (material.alpha == Material::Alpha::kIgnored) return false;
  const int texture = material.base_color_texture;
  return material.opacity < 1.0F ||
         (texture >= 0 && model.textures[static_cast<std::size_t>(texture)].channels() == 4);
}

/// Whether it differs from place to place.
bool IsTextured(const Material& material) {
  return material.base_color_texture >= 0 || material.metallic_roughness_texture >= 0;
}

}  // namespace

Result<SceneSurfaces> SceneSurfaces::Create(const std::vector<PlacedModel>& scene) {
  SceneSurfaces surfaces;
  surfaces.scene_ = scene;
  PLEINAIR_ASSIGN_OR_RETURN(surfaces.textures_.white, gl::GlTexture::Create2D(GL_RGBA8, 1, 1));
  constexpr std::array<std::uint8_t, 4> kWhite{255, 255, 255, 255};
  surfaces.textures_.white.Upload(GL_RGBA, GL_UNSIGNED_BYTE, kWhite.data());
  for (const PlacedModel& placed : scene) {
    PLEINAIR_ASSIGN_OR_RETURN(auto textures, UploadTextures(*placed.model));
    surfaces.textures_.by_model.push_back(std::move(textures));
    if (placed.is_phantom) continue;
    for (const Material& material : placed.model->materials) {
      const bool alpha = IsSeenThrough(*placed.model, material);
      surfaces.features_.alpha = surfaces.features_.alpha || alpha;
      surfaces.features_.textures = surfaces.features_.textures || alpha || IsTextured(material);
      surfaces.features_.gloss =
          surfaces.features_.gloss || material.coat.f0 > 0.0F || material.metallic > 0.0F;
    }
  }
  return surfaces;
}

bool SceneSurfaces::HasSurfacesOf(const std::vector<LitMesh>& lit) const {
  return !lit.empty() &&
         std::equal(lit.begin(), lit.end(), lit_.geometries.begin(), lit_.geometries.end(),
                    [](const LitMesh& mesh, std::uint64_t geometry) {
                      return mesh.geometry != 0 && mesh.geometry == geometry;
                    });
}

Result<void> SceneSurfaces::SetLit(const std::vector<LitMesh>& lit) {
  if (!HasSurfacesOf(lit)) PLEINAIR_RETURN_IF_ERROR(SetSurfaces(lit));
  moved_.assign(scene_.size(), glm::dmat4(1.0));
  PlaceCasters();
  std::vector<const LitMesh*> phantoms, objects;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    if (lit_.surfaces[i].is_phantom()) {
      phantoms_.triangles[phantoms.size()].SetLight(lit[i]);
      phantoms.push_back(&lit[i]);
    } else if (lit_.surfaces[i].IsDrawnObject()) {
      objects.push_back(&lit[i]);
    }
  }
  PLEINAIR_RETURN_IF_ERROR(phantoms_.buffer.SetLight(phantoms));
  return objects_.buffer.SetLight(objects);
}

Result<void> SceneSurfaces::SetSurfaces(const std::vector<LitMesh>& lit) {
  lit_.geometries.clear();
  casters_.all.clear();  // They point into the surfaces.
  casters_.phantoms.clear();
  lit_.surfaces.clear();
  lit_.surfaces.reserve(lit.size());
  lit_.bounds.clear();
  phantoms_.triangles.clear();
  objects_.triangles.clear();
  objects_.positions.clear();
  ++lit_.revision;
  std::vector<const LitMesh*> phantoms, objects;
  std::vector<float> green_albedos, object_numbers;
  for (const LitMesh& mesh : lit) {
    PLEINAIR_ASSIGN_OR_RETURN(SurfaceBuffers surface, SurfaceBuffers::Create(mesh));
    lit_.surfaces.push_back(std::move(surface));
    lit_.bounds.emplace_back();
    for (const auto& p : mesh.positions) lit_.bounds.back().Include({p[0], p[1], p[2]});
    if (mesh.is_phantom) {
      const Material& material = MaterialOf(lit_.surfaces.back());
      const bool even = material.base_color_texture < 0 && material.metallic == 0.0F;
      green_albedos.push_back(even ? material.base_color[1] : 0.0F);
      phantoms_.triangles.emplace_back(mesh);
      phantoms.push_back(&mesh);
    } else if (lit_.surfaces.back().IsDrawnObject()) {
      object_numbers.push_back(static_cast<float>(objects.size()));
      objects_.triangles.emplace_back(mesh);
      objects_.positions.emplace_back();
      objects_.positions.back().reserve(mesh.positions.size());
      for (const auto& [x, y, z] : mesh.positions) objects_.positions.back().emplace_back(x, y, z);
      objects.push_back(&mesh);
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(phantoms_.buffer, VisibilityBuffer::Create(phantoms, green_albedos));
  PLEINAIR_ASSIGN_OR_RETURN(objects_.buffer, VisibilityBuffer::Create(objects, object_numbers));
  objects_.are_sorted = false;
  lit_.geometries.reserve(lit.size());
  for (const LitMesh& mesh : lit) lit_.geometries.push_back(mesh.geometry);
  return {};
}

void SceneSurfaces::Move(int placed_model, const Mat3& linear, Vec3 translation_m) {
  glm::dmat4 moved(1.0);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) moved[column][row] = linear(row, column);
  }
  moved[3] = glm::dvec4(translation_m.x, translation_m.y, translation_m.z, 1.0);
  moved_[placed_model] = moved;
  PlaceCasters();
}

/// Casters and bounds with the models where they were moved to.
void SceneSurfaces::PlaceCasters() {
  objects_.are_placed = false;
  phantoms_.sorted_for.reset();
  casters_.all.clear();
  casters_.phantoms.clear();
  casters_.object_bounds = casters_.bounds = {};
  for (std::size_t i = 0; i < lit_.surfaces.size(); ++i) {
    const SurfaceBuffers& surface = lit_.surfaces[i];
    shadows::ShadowCaster caster;
    caster.vertices = &surface.vertex_array();
    caster.index_count = surface.index_count();
    caster.revision = lit_.revision;
    caster.marker_from_model = moved_[surface.placed_model()];
    const shadows::Box& lit = lit_.bounds[i];
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec4 point((corner & 1) != 0 ? lit.max.x : lit.min.x,
                             (corner & 2) != 0 ? lit.max.y : lit.min.y,
                             (corner & 4) != 0 ? lit.max.z : lit.min.z, 1.0);
      caster.bounds.Include(glm::dvec3(caster.marker_from_model * point));
    }
    casters_.bounds.Include(caster.bounds);
    if (!surface.is_phantom()) casters_.object_bounds.Include(caster.bounds);
    if (!surface.CastsShadow()) continue;
    if (surface.is_phantom()) casters_.phantoms.push_back(caster);
    casters_.all.push_back(caster);
  }
}

float SceneSurfaces::MaxLinearChangeFarFrom(const glm::vec3& eye_m) const {
  float maximum = 0.0F;
  for (const AffectedTriangles& triangles : phantoms_.triangles) {
    maximum = std::max(maximum, triangles.MaxLinearChangeFarFrom(eye_m));
  }
  return maximum;
}

SunFootprint SceneSurfaces::FootprintOf(const SunWindow& window) const {
  if (window.side == 0.0F) return {};
  SunFootprint footprint(window);
  std::size_t object = 0;
  std::vector<glm::vec2> at;
  for (const SurfaceBuffers& surface : lit_.surfaces) {
    if (!surface.IsDrawnObject()) continue;
    const glm::mat4 moved(moved_[surface.placed_model()]);
    at.clear();
    for (const glm::vec3& position : objects_.positions[object]) {
      at.push_back(window.At(glm::vec3(moved * glm::vec4(position, 1.0F))));
    }
    const std::span<const std::uint32_t> indices = objects_.triangles[object].indices();
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      const glm::vec2 a = at[indices[i]], b = at[indices[i + 1]], c = at[indices[i + 2]];
      footprint.Include(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c));
    }
    ++object;
  }
  return footprint;
}

bool SceneSurfaces::SunOnPhantoms::IsAsGoodAs(const SunOnPhantoms& other) const {
  // What the sky changes beside it hardly depends on it.
  constexpr float kSameSun = 0.02F;
  return window == other.window && whole == other.whole &&
         glm::all(glm::lessThanEqual(glm::abs(normal_lux - other.normal_lux),
                                     kSameSun * other.normal_lux));
}

Result<void> SceneSurfaces::SortPhantoms(const SunOnPhantoms& sun) {
  if (phantoms_.sorted_for && sun.IsAsGoodAs(*phantoms_.sorted_for)) return {};
  const SunFootprint footprint = sun.whole ? SunFootprint() : FootprintOf(sun.window);
  auto triangles = phantoms_.triangles.begin();
  std::vector<SortedTriangles> sorted;
  sorted.reserve(phantoms_.triangles.size());
  for (SurfaceBuffers& surface : lit_.surfaces) {
    if (!surface.is_phantom()) continue;
    triangles->Sort(sun.window, footprint, sun.normal_lux);
    surface.SetIndices(triangles->indices());
    sorted.push_back({triangles->indices(),
                      std::span(triangles->ends()).first(AffectedTriangles::kNothing),
                      triangles->linear_ratios()});
    ++triangles;
  }
  PLEINAIR_RETURN_IF_ERROR(phantoms_.buffer.SetTriangles(sorted));
  phantoms_.sorted_for = sun;
  return {};
}

void SceneSurfaces::DrawPhantoms(const gl::GlProgram& program) const {
  std::size_t phantom = 0;
  for (const SurfaceBuffers& surface : lit_.surfaces) {
    if (!surface.is_phantom()) continue;
    const auto& ends = phantoms_.triangles[phantom].ends();
    program.Set("u_first_id", phantoms_.buffer.first_id(phantom));
    program.Set("u_step", 1);
    surface.Draw(0, ends[AffectedTriangles::kLinearSky]);
    program.Set("u_first_id", 0);
    program.Set("u_step", 0);
    surface.Draw(ends[AffectedTriangles::kLinearSky], ends[AffectedTriangles::kNothing]);
    ++phantom;
  }
}

Result<void> SceneSurfaces::SortObjects(const glm::vec3& to_sun) {
  auto triangles = objects_.triangles.begin();
  std::vector<std::array<int, 2>> ends;
  ends.reserve(objects_.triangles.size());
  std::vector<SortedTriangles> sorted;
  sorted.reserve(objects_.triangles.size());
  for (SurfaceBuffers& surface : lit_.surfaces) {
    if (!surface.IsDrawnObject()) continue;
    // Angles stay where a model is moved, but a scale does not.
    const glm::dmat3 moved(moved_[surface.placed_model()]);
    const glm::dvec3 lit_to_sun = glm::transpose(moved) * glm::dvec3(to_sun);
    const double size = glm::length(lit_to_sun);
    if (triangles->Sort(size > 0.0 ? glm::vec3(lit_to_sun / size) : glm::vec3(0.0F))) {
      surface.SetIndices(triangles->indices());
      objects_.are_sorted = false;
    }
    if (!objects_.are_placed) {
      objects_.materials.Set(sorted.size(), MaterialOf(surface),
                             glm::mat4(moved_[surface.placed_model()]));
    }
    ends.push_back({triangles->facing_end(), surface.index_count()});
    sorted.push_back({triangles->indices(), ends.back(), {}});
    ++triangles;
  }
  if (!objects_.are_sorted) PLEINAIR_RETURN_IF_ERROR(objects_.buffer.SetTriangles(sorted));
  if (!objects_.are_placed) PLEINAIR_RETURN_IF_ERROR(objects_.materials.Upload());
  objects_.are_sorted = objects_.are_placed = true;
  return {};
}

void SceneSurfaces::DrawObjects(const gl::GlProgram& program) const {
  std::size_t object = 0;
  program.Set("u_step", 1);
  for (const SurfaceBuffers& surface : lit_.surfaces) {
    if (!surface.IsDrawnObject()) continue;
    const Material& material = MaterialOf(surface);
    const auto& textures = textures_.by_model[surface.placed_model()];
    const auto bind = [&](int texture, int unit) {
      (texture >= 0 ? textures[static_cast<std::size_t>(texture)] : textures_.white).Bind(unit);
    };
    bind(material.base_color_texture, 0);
    bind(material.metallic_roughness_texture, 1);
    program.Set("u_alpha", static_cast<int>(material.alpha));
    program.Set("u_opacity", material.opacity);
    program.Set("u_alpha_cutoff", material.alpha_cutoff);
    program.Set("u_surface", static_cast<int>(object));
    program.Set("u_marker_from_lit", glm::mat4(moved_[surface.placed_model()]));
    program.Set("u_first_id", objects_.buffer.first_id(object));
    surface.Draw();
    ++object;
  }
}

void SceneSurfaces::Draw(const gl::GlProgram& program) const {
  for (const SurfaceBuffers& surface : lit_.surfaces) {
    program.Set("u_marker_from_lit", glm::mat4(moved_[surface.placed_model()]));
    surface.Draw();
  }
}

}  // namespace pleinair::compositor
