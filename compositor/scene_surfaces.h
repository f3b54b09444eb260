#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/changing_triangles.h"
#include "compositor/facing_triangles.h"
#include "compositor/light_solver.h"
#include "compositor/surface_buffers.h"
#include "compositor/triangle_table.h"
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

  /// Tells what of the phantoms the objects may change within `window`. Errors (system): no memory.
  Result<void> SortPhantoms(const SunWindow& window);
  /// Draws the numbers that the phantoms' triangles have in triangles(), of those that change;
  /// `program` of shaders/triangle_id.frag is in use.
  void DrawPhantoms(const gl::GlProgram& program) const;
  const TriangleTable& triangles() const { return table_; }
  /// Tells which of the objects' triangles may face the sun; `to_sun` zero: none.
  void SortObjects(const glm::vec3& to_sun);
  enum class ObjectSide { kFacingSun, kTurnedAway };
  /// Draws one side of the virtual objects with `program`, which is in use: their materials and
  /// places.
  void DrawObjects(const gl::GlProgram& program, ObjectSide side) const;
  /// Draws everything with `program`, which is in use: places alone.
  void Draw(const gl::GlProgram& program) const;

 private:
  void PlaceCasters();
  void SetMaterial(const gl::GlProgram& program, const SurfaceBuffers& surface) const;

  std::vector<PlacedModel> scene_;
  gl::GlTexture white_;
  std::vector<std::vector<gl::GlTexture>> model_textures_;  // A list a placed model.
  std::vector<SurfaceBuffers> surfaces_;
  std::vector<shadows::Box> lit_bounds_;  // Of the surfaces, where they were lit.
  std::vector<glm::dmat4> moved_;         // By placed model: marker from where it was lit.
  std::vector<ChangingTriangles> phantom_triangles_;  // Of the phantoms among them, in order.
  std::vector<FacingTriangles> object_triangles_;     // Of the objects, in order.
  TriangleTable table_;
  std::optional<SunWindow> sorted_for_;
  std::vector<shadows::ShadowCaster> casters_, phantom_casters_;
  shadows::Box object_bounds_, bounds_;
  std::uint64_t revision_ = 0;  // Of the surfaces; the shadow maps follow it.
};

}  // namespace pleinair::compositor
