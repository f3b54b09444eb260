#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/models/placed_model.h"
#include "compositor/surfaces/affected_triangles.h"
#include "compositor/surfaces/material_table.h"
#include "compositor/surfaces/sun_facing_triangles.h"
#include "compositor/surfaces/surface_buffers.h"
#include "compositor/surfaces/visibility_buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "shadows/shadow_maps.h"

namespace pleinair::compositor {

/// A scene's lit surfaces in the renderer's memory, each where its model stands now. Needs a
/// current OpenGL context; move-only.
class SceneSurfaces {
 public:
  SceneSurfaces() = default;
  /// Without surfaces until SetLit(). Errors as UploadTextures().
  static Result<SceneSurfaces> Create(const std::vector<PlacedModel>& scene);

  /// As Composer::SetLight() and Composer::MoveModel().
  Result<void> SetLit(const std::vector<LitMesh>& lit);
  void Move(int placed_model, const Mat3& linear, Vec3 translation_m);

  /// For shadow maps: of everything, and of the phantoms alone.
  std::span<const shadows::ShadowCaster> casters() const { return casters_; }
  std::span<const shadows::ShadowCaster> phantom_casters() const { return phantom_casters_; }
  const shadows::Box& object_bounds() const { return object_bounds_; }
  const shadows::Box& bounds() const { return bounds_; }

  /// What of the phantoms' light objects may change depends on.
  struct SunOnPhantoms {
    SunWindow window;
    bool whole = false;          ///< The sun's light in all of it, also where no object hides it.
    glm::vec3 normal_lux{0.0F};  ///< Linear Rec.709.

    /// Whether nothing that is seen changes from one to the other.
    bool IsAsGoodAs(const SunOnPhantoms& other) const;
  };
  /// Tells what of the phantoms the objects may change under `sun`. Errors (system): no memory.
  Result<void> SortPhantoms(const SunOnPhantoms& sun);
  /// Draws the numbers that the phantoms' triangles have in triangles(), of those that change;
  /// `program` of shaders/triangle_id.frag is in use.
  void DrawPhantoms(const gl::GlProgram& program) const;
  const VisibilityBuffer& triangles() const { return phantom_buffer_; }
  /// AffectedTriangles::MaxLinearChangeFarFrom() of all phantoms.
  float MaxLinearChangeFarFrom(const glm::vec3& eye_m) const;
  /// Tells which of the objects' triangles may face the sun, `to_sun` zero: none, and where the
  /// objects stand. Errors (system): no memory.
  Result<void> SortObjects(const glm::vec3& to_sun);
  /// Draws the numbers that the objects' triangles have in object_triangles(), with their textures;
  /// `program` of shaders/triangle_id.frag is in use.
  void DrawObjects(const gl::GlProgram& program) const;
  const VisibilityBuffer& object_triangles() const { return object_buffer_; }
  /// By the values of object_triangles().
  const MaterialTable& object_materials() const { return object_materials_; }
  /// Some of the objects have textures or alpha.
  bool HasTextures() const { return has_textures_; }
  /// Some mirror their surroundings: a metal or a coat does.
  bool HasGloss() const { return has_gloss_; }
  /// Some have holes or are glass.
  bool HasAlpha() const { return has_alpha_; }
  /// Draws everything with `program`, which is in use: places alone.
  void Draw(const gl::GlProgram& program) const;

 private:
  /// Whether the surfaces are those of `lit`, so that there is nothing new but their light.
  bool HasSurfacesOf(const std::vector<LitMesh>& lit) const;
  Result<void> SetSurfaces(const std::vector<LitMesh>& lit);
  void PlaceCasters();
  /// What the objects cover of `window` where they stand now.
  SunFootprint FootprintOf(const SunWindow& window) const;
  const Material& MaterialOf(const SurfaceBuffers& surface) const {
    return scene_[surface.placed_model()].model->materials[surface.material()];
  }

  std::vector<PlacedModel> scene_;
  bool has_textures_ = false, has_alpha_ = false, has_gloss_ = false;
  gl::GlTexture white_;
  std::vector<std::vector<gl::GlTexture>> model_textures_;  // A list a placed model.
  std::vector<SurfaceBuffers> surfaces_;
  std::vector<std::uint64_t> geometries_;  // LitMesh::geometry of the surfaces.
  std::vector<shadows::Box> lit_bounds_;   // Of the surfaces, where they were lit.
  std::vector<glm::dmat4> moved_;          // By placed model: marker from where it was lit.
  std::vector<AffectedTriangles> phantom_triangles_;      // Of the phantoms among them, in order.
  std::vector<SunFacingTriangles> object_triangles_;      // Of the objects, in order.
  std::vector<std::vector<glm::vec3>> object_positions_;  // Of their vertices, where they were lit.
  VisibilityBuffer phantom_buffer_, object_buffer_;
  MaterialTable object_materials_;
  // object_buffer_ and object_materials_ are as object_triangles_ and moved_ are.
  bool objects_sorted_ = false, objects_placed_ = false;
  std::optional<SunOnPhantoms> sorted_for_;  // As SortPhantoms() was called.
  std::vector<shadows::ShadowCaster> casters_, phantom_casters_;
  shadows::Box object_bounds_, bounds_;
  std::uint64_t revision_ = 0;  // Of the surfaces; the shadow maps follow it.
};

}  // namespace pleinair::compositor
