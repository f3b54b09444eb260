#pragma once

#include "base/error.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/render_targets.h"
#include "compositor/passes/scene_view.h"
#include "compositor/passes/surface_programs.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"

namespace pleinair::compositor {

/// The virtual objects, each piece of surface in a pixel shaded once: first which triangle each
/// sample shows, then what of a pixel is to be shaded, then that alone. Needs a current OpenGL
/// context; move-only.
class ObjectPass {
 public:
  ObjectPass() = default;
  /// Errors as gl::GlProgram::Create.
  static Result<ObjectPass> Create();

  /// Draws which triangles of the objects the samples show, over the numbers of the real surfaces
  /// that ShadowRatioPass::DrawSurfaces() drew and behind their depth. Binds textures to unit 0.
  void DrawSurfaces(const RenderTargets& targets, const SceneSurfaces& surfaces,
                    const FrameUniforms& frame) const;

  /// Shades what DrawSurfaces() found into targets.objects(). `within`: where objects are in the
  /// picture. The shadow maps and, at unit 5, the map of the sunlight must have been bound, and
  /// GL_DEPTH_TEST be enabled and GL_CULL_FACE not. Binds textures of its own to units 0 to 4, 6
  /// and 7; leaves the depth written and tested with GL_LESS, and no scissors.
  void Draw(const RenderTargets& targets, const SceneSurfaces& surfaces,
            const SurfacePrograms& programs, const FrameUniforms& frame,
            const gl::GlTexture& environment, const PixelRect& within) const;

 private:
  gl::GlProgram id_program_, textured_id_program_, alpha_id_program_, sort_program_;
  gl::GlVertexArray no_attributes_;
};

}  // namespace pleinair::compositor
