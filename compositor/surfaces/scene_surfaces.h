#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/models/placed_model.h"
#include "compositor/surfaces/draw_reduction.h"
#include "compositor/surfaces/material_table.h"
#include "compositor/surfaces/scene_materials.h"
#include "compositor/surfaces/surface_buffers.h"
#include "compositor/surfaces/surface_placement.h"
#include "compositor/surfaces/visibility_buffer.h"
#include "gl/program.h"

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

  /// As Composer::SetOptions() for ComposerOptions::reductions.
  void Use(const DrawReductions& reductions) { reduction_.Use(reductions); }

  /// Where the surfaces stand now.
  const SurfacePlacement& placement() const { return placement_; }
  const SceneMaterials& materials() const { return materials_; }

  /// Tells what of the phantoms the objects may change under `sun`. Errors (system): no memory.
  Result<void> SortPhantoms(const SunOnPhantoms& sun);
  /// Draws the numbers that the phantoms' triangles have in triangles(), of those that change;
  /// `program` of shaders/triangle_id.frag is in use.
  void DrawPhantoms(const gl::GlProgram& program) const;
  const VisibilityBuffer& triangles() const { return phantom_buffer_; }
  /// AffectedTriangles::MaxLinearChangeFarFrom() of all phantoms.
  float MaxLinearChangeFarFrom(const glm::vec3& eye_m) const {
    return reduction_.MaxLinearChangeFarFrom(eye_m);
  }
  /// Tells which of the objects' triangles may face the sun, `to_sun` zero: none, and where the
  /// objects stand. Errors (system): no memory.
  Result<void> SortObjects(const glm::vec3& to_sun);
  /// Draws the numbers that the objects' triangles have in object_triangles(), with their textures;
  /// `program` of shaders/triangle_id.frag is in use.
  void DrawObjects(const gl::GlProgram& program) const;
  const VisibilityBuffer& object_triangles() const { return object_buffer_; }
  /// By the values of object_triangles().
  const MaterialTable& object_materials() const { return object_materials_; }
  /// Draws everything with `program`, which is in use: places alone.
  void Draw(const gl::GlProgram& program) const;

 private:
  /// Whether the surfaces are those of `lit`, so that there is nothing new but their light.
  bool HasSurfacesOf(const std::vector<LitMesh>& lit) const;
  Result<void> SetSurfaces(const std::vector<LitMesh>& lit);
  const Material& MaterialOf(const SurfaceBuffers& surface) const {
    return materials_.Of(surface.placed_model(), surface.material());
  }

  SceneMaterials materials_;
  std::vector<SurfaceBuffers> surfaces_;
  std::vector<std::uint64_t> geometries_;  // LitMesh::geometry of the surfaces.
  SurfacePlacement placement_;
  DrawReduction reduction_;  // Of the phantoms and the drawn objects among them, in order.
  VisibilityBuffer phantom_buffer_, object_buffer_;
  MaterialTable object_materials_;
  // object_buffer_ is as reduction_ has the objects, object_materials_ as they stand.
  bool objects_sorted_ = false, objects_placed_ = false;
};

}  // namespace pleinair::compositor
