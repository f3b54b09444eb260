#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/models/placed_model.h"
#include "compositor/surfaces/draw_reduction.h"
#include "compositor/surfaces/drawn_mesh.h"
#include "compositor/surfaces/image_tiles.h"
#include "compositor/surfaces/material_table.h"
#include "compositor/surfaces/scene_materials.h"
#include "compositor/surfaces/surface_buffers.h"
#include "compositor/surfaces/surface_placement.h"
#include "compositor/surfaces/visibility_buffer.h"
#include "gl/program.h"

namespace pleinair::compositor {

/// A scene's lit surfaces in GPU memory, each at its model's current place. Needs a current OpenGL
/// context; move-only.
class SceneSurfaces {
 public:
  SceneSurfaces() = default;
  /// Makes a scene without surfaces until SetLit(). Errors as UploadTextures().
  static Result<SceneSurfaces> Create(const std::vector<PlacedModel>& scene);

  /// As Composer::SetLight(), SetLightMix() and MoveModel().
  Result<void> SetLit(const std::vector<LitMesh>& lit);
  Result<void> SetMix(const std::vector<LitMesh>& lit, const LightMix& mix);
  /// Takes other surfaces; models that have moved stay there. SetMix() must follow. Errors: no
  /// memory.
  Result<void> Replace(const std::vector<LitMesh>& lit);
  /// Sets the colors of sun and sky, by which leaves change theirs.
  void SetLightColors(LinearRgb sun, LinearRgb sky);
  void Move(int placed_model, const Mat3& linear, Vec3 translation_m);
  /// Gives the surfaces from `first` on the shape of `lit`, whose triangles are those of SetLit().
  /// `lit` must outlive the shape. SetMix() must follow.
  void SetShapes(const std::vector<LitMesh>& lit, std::size_t first);

  /// As Composer::SetOptions() for ComposerOptions::reductions.
  void Use(const DrawReductions& reductions) { reduction_.Use(reductions); }

  /// The surfaces' current placement.
  const SurfacePlacement& placement() const { return placement_; }
  const SceneMaterials& materials() const { return materials_; }

  /// Classifies the phantoms' triangles by what objects may change under `sun`. Errors (system): no
  /// memory.
  Result<void> SortPhantoms(const SunOnPhantoms& sun);
  /// Returns the tiles of an image that the sorted surfaces affect. `image`: with
  /// clip_from_position for marker coordinates.
  AffectedTiles TilesOf(const SceneProjection& image) const;
  /// Sets whether triangles() also has the phantoms' triangles that nothing affects, from the next
  /// SortPhantoms() on.
  void NumberAll(bool all);
  enum class Numbered { kAffected, kAll };
  /// Draws the triangle numbers of triangles() for the phantoms, with 0 for the triangles that are
  /// not `numbered`. `program` with shaders/triangle_id.frag must be in use.
  void DrawPhantoms(const gl::GlProgram& program, Numbered numbered = Numbered::kAffected) const;
  const VisibilityBuffer& triangles() const { return phantom_buffer_; }
  /// Max. of AffectedTriangles::MaxLinearChangeFarFrom() over all phantoms.
  float MaxLinearChangeFarFrom(const glm::vec3& eye_m) const {
    return reduction_.MaxLinearChangeFarFrom(eye_m);
  }
  /// Updates the objects' sun-facing triangles and placement. A zero `to_sun` means that no
  /// triangle faces the sun. Errors (system): no memory.
  Result<void> SortObjects(const glm::vec3& to_sun);
  /// Draws the triangle numbers of object_triangles(), with the objects' textures. `program` with
  /// shaders/triangle_id.frag must be in use.
  void DrawObjects(const gl::GlProgram& program) const;
  const VisibilityBuffer& object_triangles() const { return object_buffer_; }
  /// Indexed by the values of object_triangles().
  const MaterialTable& object_materials() const { return object_materials_; }
  /// The sorted surfaces in the order of drawing: DrawPhantoms(), then DrawObjects().
  std::vector<DrawnMesh> DrawnMeshes();
  /// Draws the geometry of all surfaces with `program`, which must be in use.
  void Draw(const gl::GlProgram& program) const;

 private:
  /// Edges by which the processor finds silhouettes.
  struct Outlines {
    std::vector<std::vector<OutlineEdge>> edges = {};  // One a surface.
    std::size_t first_changing = ~std::size_t{0};      // Surfaces from here on change their shape.
    bool have_all = true;                              // Whether the changing ones have all edges.
  };
  /// Finds all edges of the surfaces that change their shape.
  void FindChangingOutlines();
  /// Returns whether the surfaces are those of `lit`, so that only their light is new.
  bool HasSurfacesOf(const std::vector<LitMesh>& lit) const;
  Result<void> SetSurfaces(const std::vector<LitMesh>& lit);
  /// One per object that reduction_ has: its transform from where it was lit.
  std::vector<glm::mat4> ObjectsMoved() const;
  const Material& MaterialOf(const SurfaceBuffers& surface) const {
    return materials_.Of(surface.placed_model(), surface.material());
  }

  SceneMaterials materials_;
  std::vector<SurfaceBuffers> surfaces_;
  std::vector<std::uint64_t> geometries_;  // LitMesh::geometry of the surfaces.
  SurfacePlacement placement_;
  DrawReduction reduction_;  // Phantoms and drawn objects among the surfaces, in order.
  VisibilityBuffer phantom_buffer_, object_buffer_;
  MaterialTable object_materials_;
  Outlines outlines_;
  // Whether object_buffer_ matches reduction_, and object_materials_ the current placement.
  bool objects_sorted_ = false, objects_placed_ = false;
  bool numbers_all_ = false;
};

}  // namespace pleinair::compositor
