#pragma once

#include "base/error.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/render_targets.h"
#include "compositor/passes/surface_programs.h"
#include "compositor/surfaces/affected_triangles.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "gl/program.h"
#include "gl/vertex_array.h"

namespace pleinair::compositor {

/// What the virtual objects change of the real surfaces' light, once a pixel: first which triangle
/// each sample of the picture shows, then what of a pixel is to be shaded, then that alone. Needs
/// a current OpenGL context; move-only.
class ShadowRatioPass {
 public:
  ShadowRatioPass() = default;
  /// Errors as gl::GlProgram::Create.
  static Result<ShadowRatioPass> Create();

  /// Draws which triangles of the real surfaces the samples show, and their depth. What objects are
  /// drawn before them afterwards is left out by Draw().
  void DrawSurfaces(const RenderTargets& targets, const SceneSurfaces& surfaces,
                    const FrameUniforms& frame) const;

  struct ShadowOptions {
    bool assume_unmodelled = true;  ///< Composer::AssumeUnmodelledShadows().
    double margin_size_m = 0.0;     ///< Composer::SetMarkerMargin().
  };
  /// Shades what DrawSurfaces() found, once the objects are drawn.
  /// CameraPicture::BindForShading(2, 3, 4), the shadow maps and the map of the sunlight at unit 5
  /// must have been bound, and GL_DEPTH_TEST be enabled and GL_CULL_FACE not. Binds textures of its
  /// own to units 0, 1, 6 and 7; leaves the depth written and tested with GL_LESS, and no blending.
  void Draw(const RenderTargets& targets, const SceneSurfaces& surfaces,
            const SurfacePrograms& programs, const FrameUniforms& frame,
            const ShadowOptions& options) const;

  /// Depth by which the pixels are sorted of which no more than this changes: twin of
  /// shaders/visibility_buffer_layout.glsl.
  static constexpr float DepthOf(AffectedTriangles::Change change) {
    return 0.125F * static_cast<float>(change + 1);
  }

 private:
  gl::GlProgram id_program_, sort_program_;
  gl::GlProgram linear_program_, linear_program_with_airlight_;
  gl::GlVertexArray no_attributes_;
};

}  // namespace pleinair::compositor
