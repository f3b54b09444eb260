#include "compositor/scene_surfaces.h"

#include <array>
#include <cstddef>
#include <utility>

namespace pleinair::compositor {

Result<SceneSurfaces> SceneSurfaces::Create(const std::vector<PlacedModel>& scene) {
  SceneSurfaces surfaces;
  surfaces.scene_ = scene;
  PLEINAIR_ASSIGN_OR_RETURN(surfaces.white_, gl::GlTexture::Create2D(GL_RGBA8, 1, 1));
  constexpr std::array<std::uint8_t, 4> kWhite{255, 255, 255, 255};
  surfaces.white_.Upload(GL_RGBA, GL_UNSIGNED_BYTE, kWhite.data());
  for (const PlacedModel& placed : scene) {
    PLEINAIR_ASSIGN_OR_RETURN(auto textures, UploadTextures(*placed.model));
    surfaces.model_textures_.push_back(std::move(textures));
  }
  return surfaces;
}

Result<void> SceneSurfaces::SetLit(const std::vector<LitMesh>& lit) {
  surfaces_.clear();
  surfaces_.reserve(lit.size());  // The casters point into it.
  lit_bounds_.clear();
  moved_.assign(scene_.size(), glm::dmat4(1.0));
  phantom_triangles_.clear();
  object_triangles_.clear();
  sorted_for_.reset();
  ++revision_;
  std::vector<float> green_albedo;
  for (const LitMesh& mesh : lit) {
    PLEINAIR_ASSIGN_OR_RETURN(SurfaceBuffers surface, SurfaceBuffers::Create(mesh));
    surfaces_.push_back(std::move(surface));
    lit_bounds_.emplace_back();
    for (const auto& p : mesh.positions) lit_bounds_.back().Include({p[0], p[1], p[2]});
    if (mesh.is_phantom) {
      phantom_triangles_.emplace_back(mesh);
    } else {
      object_triangles_.emplace_back(mesh);
    }
    const Material& material = scene_[mesh.placed_model].model->materials[mesh.material];
    const bool even = material.base_color_texture < 0 && material.metallic == 0.0F;
    green_albedo.push_back(even ? material.base_color[1] : 0.0F);
  }
  PLEINAIR_ASSIGN_OR_RETURN(table_, TriangleTable::Create(lit, green_albedo));
  PlaceCasters();
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
  casters_.clear();
  phantom_casters_.clear();
  object_bounds_ = bounds_ = {};
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const SurfaceBuffers& surface = surfaces_[i];
    shadows::ShadowCaster caster;
    caster.vertices = &surface.vertex_array();
    caster.index_count = surface.index_count();
    caster.revision = revision_;
    caster.marker_from_model = moved_[surface.placed_model()];
    const shadows::Box& lit = lit_bounds_[i];
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec4 point((corner & 1) != 0 ? lit.max.x : lit.min.x,
                             (corner & 2) != 0 ? lit.max.y : lit.min.y,
                             (corner & 4) != 0 ? lit.max.z : lit.min.z, 1.0);
      caster.bounds.Include(glm::dvec3(caster.marker_from_model * point));
    }
    bounds_.Include(caster.bounds);
    if (surface.is_phantom()) {
      phantom_casters_.push_back(caster);
    } else {
      object_bounds_.Include(caster.bounds);
    }
    casters_.push_back(caster);
  }
}

Result<void> SceneSurfaces::SortPhantoms(const SunWindow& window) {
  if (window == sorted_for_) return {};
  auto triangles = phantom_triangles_.begin();
  for (SurfaceBuffers& surface : surfaces_) {
    if (!surface.is_phantom()) continue;
    triangles->Sort(window);
    surface.SetIndices(triangles->indices());
    ++triangles;
  }
  PLEINAIR_RETURN_IF_ERROR(table_.SetTriangles(phantom_triangles_));
  sorted_for_ = window;
  return {};
}

void SceneSurfaces::DrawPhantoms(const gl::GlProgram& program) const {
  std::size_t phantom = 0;
  for (const SurfaceBuffers& surface : surfaces_) {
    if (!surface.is_phantom()) continue;
    const auto& ends = phantom_triangles_[phantom].ends();
    program.Set("u_first_id", table_.first_id(phantom));
    program.Set("u_step", 1);
    surface.Draw(0, ends[ChangingTriangles::kSky]);
    program.Set("u_first_id", 0);
    program.Set("u_step", 0);
    surface.Draw(ends[ChangingTriangles::kSky], ends[ChangingTriangles::kNothing]);
    ++phantom;
  }
}

void SceneSurfaces::SetMaterial(const gl::GlProgram& program, const SurfaceBuffers& surface) const {
  const Model& model = *scene_[surface.placed_model()].model;
  const Material& material = model.materials[surface.material()];
  const gl::GlTexture& texture =
      material.base_color_texture >= 0
          ? model_textures_[surface.placed_model()][material.base_color_texture]
          : white_;
  texture.Bind(0);
  program.Set("u_base_color",
              glm::vec3(material.base_color[0], material.base_color[1], material.base_color[2]));
  program.Set("u_metallic", material.metallic);
  program.Set("u_roughness", material.roughness);
  program.Set("u_dielectric_f0", material.specular_f0);
}

void SceneSurfaces::SortObjects(const glm::vec3& to_sun) {
  auto triangles = object_triangles_.begin();
  for (SurfaceBuffers& surface : surfaces_) {
    if (surface.is_phantom()) continue;
    // Angles stay where a model is moved, but a scale does not.
    const glm::dmat3 moved(moved_[surface.placed_model()]);
    const glm::dvec3 lit_to_sun = glm::transpose(moved) * glm::dvec3(to_sun);
    const double size = glm::length(lit_to_sun);
    if (triangles->Sort(size > 0.0 ? glm::vec3(lit_to_sun / size) : glm::vec3(0.0F))) {
      surface.SetIndices(triangles->indices());
    }
    ++triangles;
  }
}

void SceneSurfaces::DrawObjects(const gl::GlProgram& program, ObjectSide side) const {
  auto triangles = object_triangles_.begin();
  for (const SurfaceBuffers& surface : surfaces_) {
    if (surface.is_phantom()) continue;
    SetMaterial(program, surface);
    program.Set("u_marker_from_lit", glm::mat4(moved_[surface.placed_model()]));
    const int facing = triangles->facing_end();
    if (side == ObjectSide::kFacingSun) {
      surface.Draw(0, facing);
    } else {
      surface.Draw(facing, surface.index_count());
    }
    ++triangles;
  }
}

void SceneSurfaces::Draw(const gl::GlProgram& program) const {
  for (const SurfaceBuffers& surface : surfaces_) {
    program.Set("u_marker_from_lit", glm::mat4(moved_[surface.placed_model()]));
    surface.Draw();
  }
}

}  // namespace pleinair::compositor
