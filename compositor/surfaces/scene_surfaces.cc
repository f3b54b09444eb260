#include "compositor/surfaces/scene_surfaces.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace pleinair::compositor {

namespace {

constexpr GLuint kColorAttribute = 3;  // In shaders/scene_surface.vert.

void SetCoordinates(const std::string& name, const TextureCoordinates& coordinates,
                    const gl::GlProgram& program) {
  const auto& [uu, uv, vu, vv] = coordinates.matrix;
  program.Set(name + "_rows", glm::vec4(uu, uv, vu, vv));
  program.Set(name + "_offset", glm::vec3(coordinates.offset[0], coordinates.offset[1],
                                          coordinates.second_set ? 1.0F : 0.0F));
}

/// Uniforms of the permutation DETAILED of shaders/triangle_id.frag.
void SetDetail(const MaterialDetail& detail, bool is_back, const gl::GlProgram& program) {
  const float side = is_back ? -1.0F : 1.0F;
  program.Set("u_normal_scale",
              detail.normal_map.texture >= 0 ? side * detail.normal_map.scale : 0.0F);
  SetCoordinates("u_coat", detail.metallic_roughness_coordinates, program);
  SetCoordinates("u_normal", detail.normal_map.coordinates, program);
  SetCoordinates("u_emission",
                 detail.transmission.texture >= 0 ? detail.transmission.coordinates
                                                  : detail.emission.coordinates,
                 program);
}

/// Numbers the blended surfaces as they are drawn: one number for both sides of one.
class PaneNumbers {
 public:
  int Next(const SurfaceBuffers& surface) {
    const bool is_other_side = last_ != nullptr && last_->is_back() != surface.is_back() &&
                               last_->placed_model() == surface.placed_model() &&
                               last_->material() == surface.material();
    if (!is_other_side) ++number_;
    last_ = is_other_side ? nullptr : &surface;
    return number_;
  }

 private:
  const SurfaceBuffers* last_ = nullptr;
  int number_ = -1;
};

/// True without colors of vertices, too.
bool HasOneColor(const std::vector<VertexDetail>& details) {
  return std::ranges::all_of(
      details, [&](const VertexDetail& detail) { return detail.color == details[0].color; });
}

std::vector<OutlineEdge> EdgesOfMesh(const LitMesh& mesh) {
  const auto vectors = [](const std::vector<std::array<float, 3>>& arrays) {
    std::vector<glm::vec3> converted;
    converted.reserve(arrays.size());
    for (const auto& a : arrays) converted.emplace_back(a[0], a[1], a[2]);
    return converted;
  };
  return OutlineOf(vectors(mesh.positions), vectors(mesh.normals), mesh.indices);
}

}  // namespace

Result<SceneSurfaces> SceneSurfaces::Create(const std::vector<PlacedModel>& scene) {
  SceneSurfaces surfaces;
  PLEINAIR_ASSIGN_OR_RETURN(surfaces.materials_, SceneMaterials::Create(scene));
  return surfaces;
}

bool SceneSurfaces::HasSurfacesOf(const std::vector<LitMesh>& lit) const {
  return !lit.empty() && std::equal(lit.begin(), lit.end(), geometries_.begin(), geometries_.end(),
                                    [](const LitMesh& mesh, std::uint64_t geometry) {
                                      return mesh.geometry != 0 && mesh.geometry == geometry;
                                    });
}

Result<void> SceneSurfaces::SetLit(const std::vector<LitMesh>& lit) {
  if (!HasSurfacesOf(lit)) PLEINAIR_RETURN_IF_ERROR(SetSurfaces(lit));
  placement_.Reset(materials_.model_count(), surfaces_);
  objects_placed_ = false;
  return SetMix(lit, {});
}

Result<void> SceneSurfaces::Replace(const std::vector<LitMesh>& lit) {
  PLEINAIR_RETURN_IF_ERROR(SetSurfaces(lit));
  placement_.Refresh(surfaces_);
  objects_placed_ = false;
  return {};
}

Result<void> SceneSurfaces::SetMix(const std::vector<LitMesh>& lit, const LightMix& mix) {
  reduction_.Invalidate();
  std::vector<const LitMesh*> phantoms, objects;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    if (surfaces_[i].is_phantom()) {
      reduction_.SetLight(phantoms.size(), lit[i], mix);
      phantoms.push_back(&lit[i]);
    } else if (surfaces_[i].IsDrawnObject()) {
      objects.push_back(&lit[i]);
    }
  }
  PLEINAIR_RETURN_IF_ERROR(phantom_buffer_.SetLight(phantoms, mix));
  return object_buffer_.SetLight(objects, mix);
}

Result<void> SceneSurfaces::SetSurfaces(const std::vector<LitMesh>& lit) {
  geometries_.clear();
  outlines_ = {};
  placement_.Clear();  // It refers to the surfaces.
  surfaces_.clear();
  surfaces_.reserve(lit.size());
  outlines_.edges.reserve(lit.size());
  reduction_.Clear();
  std::vector<const LitMesh*> phantoms, objects;
  std::vector<float> green_albedos, object_numbers;
  for (const LitMesh& mesh : lit) {
    PLEINAIR_ASSIGN_OR_RETURN(SurfaceBuffers surface, SurfaceBuffers::Create(mesh));
    surfaces_.push_back(std::move(surface));
    outlines_.edges.push_back(EdgesOfMesh(mesh));
    placement_.Add(mesh, outlines_.edges.back());
    if (const PlacedModel& placed = materials_.Placed(mesh.placed_model);
        placed.playback.animation) {
      placement_.IncludeShapes(BoundsOfShapes(placed));
    }
    if (mesh.is_phantom) {
      const Material& material = MaterialOf(surfaces_.back());
      const bool even = material.base_color_texture < 0 && material.metallic == 0.0F &&
                        HasOneColor(mesh.texturing.details);
      green_albedos.push_back(even ? mesh.texturing.reflectance[1] : 0.0F);
      reduction_.AddPhantom(mesh);
      phantoms.push_back(&mesh);
    } else if (surfaces_.back().IsDrawnObject()) {
      object_numbers.push_back(static_cast<float>(objects.size()));
      reduction_.AddObject(mesh);
      objects.push_back(&mesh);
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(phantom_buffer_, VisibilityBuffer::Create(phantoms, green_albedos));
  PLEINAIR_ASSIGN_OR_RETURN(object_buffer_, VisibilityBuffer::Create(objects, object_numbers));
  objects_sorted_ = false;
  geometries_.reserve(lit.size());
  for (const LitMesh& mesh : lit) geometries_.push_back(mesh.geometry);
  return {};
}

void SceneSurfaces::SetLightColors(LinearRgb sun, LinearRgb sky) {
  if (!materials_.HasTranslucent()) return;
  materials_.SetLight(sun, sky);
  objects_placed_ = false;
}

void SceneSurfaces::Move(int placed_model, const Mat3& linear, Vec3 translation_m) {
  placement_.Move(placed_model, linear, translation_m, surfaces_);
  objects_placed_ = false;
  reduction_.Invalidate();
}

void SceneSurfaces::SetShapes(const std::vector<LitMesh>& lit, std::size_t first) {
  if (first != outlines_.first_changing) {
    outlines_.first_changing = first;
    outlines_.have_all = false;
  }
  std::size_t object = 0;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const bool is_drawn = surfaces_[i].IsDrawnObject();
    if (i >= first) {
      surfaces_[i].SetVertices(lit[i]);
      placement_.SetShape(i, lit[i]);
      if (is_drawn) reduction_.SetShape(object, lit[i]);
    }
    if (is_drawn) ++object;
  }
  placement_.Refresh(surfaces_);
}

std::vector<glm::mat4> SceneSurfaces::ObjectsMoved() const {
  std::vector<glm::mat4> moved;
  for (const SurfaceBuffers& surface : surfaces_) {
    if (!surface.IsDrawnObject()) continue;
    moved.emplace_back(placement_.MovedBy(surface.placed_model()));
  }
  return moved;
}

AffectedTiles SceneSurfaces::TilesOf(const SceneProjection& image) const {
  return reduction_.TilesOf(image, ObjectsMoved());
}

Result<void> SceneSurfaces::SortPhantoms(const SunOnPhantoms& sun) {
  if (reduction_.AreSortedFor(sun)) return {};
  reduction_.SortPhantoms(sun, ObjectsMoved());
  auto triangles = reduction_.phantoms().begin();
  std::vector<SortedTriangles> sorted;
  sorted.reserve(reduction_.phantoms().size());
  for (SurfaceBuffers& surface : surfaces_) {
    if (!surface.is_phantom()) continue;
    surface.SetIndices(triangles->indices());
    const std::span ends(triangles->ends());
    sorted.push_back({triangles->indices(),
                      numbers_all_ ? ends : ends.first(AffectedTriangles::kNothing),
                      triangles->linear_ratios(),
                      static_cast<std::size_t>(ends[AffectedTriangles::kSunlitSky]) / 3});
    ++triangles;
  }
  Result<void> set = phantom_buffer_.SetTriangles(sorted);
  if (!set) reduction_.Invalidate();
  return set;
}

void SceneSurfaces::NumberAll(bool all) {
  if (all == numbers_all_) return;
  numbers_all_ = all;
  reduction_.Invalidate();
}

void SceneSurfaces::DrawPhantoms(const gl::GlProgram& program, Numbered numbered) const {
  const auto last =
      numbered == Numbered::kAll ? AffectedTriangles::kNothing : AffectedTriangles::kLinearSky;
  std::size_t phantom = 0;
  for (const SurfaceBuffers& surface : surfaces_) {
    if (!surface.is_phantom()) continue;
    const auto& ends = reduction_.phantoms()[phantom].ends();
    program.Set("u_first_id", phantom_buffer_.first_id(phantom));
    program.Set("u_step", 1);
    surface.Draw(0, ends[last]);
    program.Set("u_first_id", 0);
    program.Set("u_step", 0);
    surface.Draw(ends[last], ends[AffectedTriangles::kNothing]);
    ++phantom;
  }
}

Result<void> SceneSurfaces::SortObjects(const glm::vec3& to_sun) {
  auto triangles = reduction_.objects().begin();
  std::vector<SortedTriangles> sorted;
  sorted.reserve(reduction_.objects().size());
  for (SurfaceBuffers& surface : surfaces_) {
    if (!surface.IsDrawnObject()) continue;
    // The transpose keeps the angles between sun and normals. The division removes the scale.
    const glm::dmat3 moved(placement_.MovedBy(surface.placed_model()));
    const glm::dvec3 lit_to_sun = glm::transpose(moved) * glm::dvec3(to_sun);
    const double size = glm::length(lit_to_sun);
    if (reduction_.SortObject(sorted.size(),
                              size > 0.0 ? glm::vec3(lit_to_sun / size) : glm::vec3(0.0F))) {
      surface.SetIndices(triangles->indices());
      objects_sorted_ = false;
    }
    if (!objects_placed_) {
      object_materials_.Set(sorted.size(), MaterialOf(surface),
                            materials_.TintsOf(surface.placed_model(), surface.material()),
                            glm::mat4(placement_.MovedBy(surface.placed_model())));
    }
    sorted.push_back({triangles->indices(), triangles->ends(), {}, 0});
    ++triangles;
  }
  if (!objects_sorted_) PLEINAIR_RETURN_IF_ERROR(object_buffer_.SetTriangles(sorted));
  if (!objects_placed_) PLEINAIR_RETURN_IF_ERROR(object_materials_.Upload());
  objects_sorted_ = objects_placed_ = true;
  return {};
}

void SceneSurfaces::DrawObjects(const gl::GlProgram& program) const {
  std::size_t object = 0;
  PaneNumbers panes;
  program.Set("u_step", 1);
  const bool detailed = materials_.HasDetails();
  // Meshes without vertex details are white.
  if (detailed) glVertexAttrib4f(kColorAttribute, 1.0F, 1.0F, 1.0F, 1.0F);
  for (const SurfaceBuffers& surface : surfaces_) {
    if (!surface.IsDrawnObject()) continue;
    const Material& material = MaterialOf(surface);
    materials_.BindTextures(surface.placed_model(), material);
    program.Set("u_alpha", static_cast<int>(material.alpha));
    program.Set("u_opacity", material.opacity);
    program.Set("u_alpha_cutoff", material.alpha_cutoff);
    program.Set("u_surface", static_cast<int>(object));
    if (material.alpha == Material::Alpha::kBlended) program.Set("u_pane", panes.Next(surface));
    program.Set("u_marker_from_lit", glm::mat4(placement_.MovedBy(surface.placed_model())));
    program.Set("u_first_id", object_buffer_.first_id(object));
    if (detailed) SetDetail(material.detail, surface.is_back(), program);
    surface.Draw();
    ++object;
  }
}

void SceneSurfaces::FindChangingOutlines() {
  std::size_t phantom = 0, object = 0;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const bool changes = i >= outlines_.first_changing;
    if (surfaces_[i].is_phantom()) {
      const AffectedTriangles& mesh = reduction_.phantoms()[phantom++];
      if (changes) {
        outlines_.edges[i] = OutlineOf(mesh.positions(), mesh.normals(), mesh.indices(), true);
      }
    } else if (surfaces_[i].IsDrawnObject()) {
      const std::size_t at = object++;
      const SunFacingTriangles& mesh = reduction_.objects()[at];
      if (changes) {
        outlines_.edges[i] =
            OutlineOf(reduction_.object_positions(at), mesh.normals(), mesh.indices(), true);
      }
    }
  }
  outlines_.have_all = true;
}

std::vector<DrawnMesh> SceneSurfaces::DrawnMeshes() {
  if (!outlines_.have_all) FindChangingOutlines();
  std::vector<DrawnMesh> phantoms, objects;
  phantoms.reserve(surfaces_.size());
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    const SurfaceBuffers& surface = surfaces_[i];
    const glm::mat4 moved(placement_.MovedBy(surface.placed_model()));
    if (surface.is_phantom()) {
      const std::size_t at = phantoms.size();
      const AffectedTriangles& phantom = reduction_.phantoms()[at];
      phantoms.push_back({.positions = phantom.positions(),
                          .indices = phantom.indices(),
                          .ends = std::span(phantom.ends()).first(AffectedTriangles::kNothing),
                          .components = phantom_buffer_.components(at),
                          .outline = outlines_.edges[i],
                          .first_id = static_cast<std::uint32_t>(phantom_buffer_.first_id(at))});
    } else if (surface.IsDrawnObject()) {
      const std::size_t at = objects.size();
      const SunFacingTriangles& object = reduction_.objects()[at];
      objects.push_back(
          {.positions = reduction_.object_positions(at),
           .indices = object.indices(),
           .ends = object.ends(),
           .components = object_buffer_.components(at),
           .outline = outlines_.edges[i],
           .marker_from_lit = moved,
           .first_id = static_cast<std::uint32_t>(object_buffer_.first_id(at)),
           .is_object = true,
           .has_holes = materials_.HasHoles(surface.placed_model(), surface.material())});
    }
  }
  phantoms.insert(phantoms.end(), objects.begin(), objects.end());
  return phantoms;
}

void SceneSurfaces::Draw(const gl::GlProgram& program) const {
  for (const SurfaceBuffers& surface : surfaces_) {
    program.Set("u_marker_from_lit", glm::mat4(placement_.MovedBy(surface.placed_model())));
    surface.Draw();
  }
}

}  // namespace pleinair::compositor
