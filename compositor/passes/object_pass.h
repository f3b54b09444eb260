#pragma once

#include <span>

#include "base/error.h"
#include "compositor/passes/coverage_pass.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/render_targets.h"
#include "compositor/passes/surface_programs.h"
#include "compositor/surfaces/image_tiles.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"

namespace pleinair::compositor {

/// Draws the virtual objects and shades each piece of surface in a pixel once. It draws triangle
/// numbers per sample, classifies the pixels, and shades only those that need it. Needs a current
/// OpenGL context; move-only.
class ObjectPass {
 public:
  ObjectPass() = default;
  /// `detailed`: SceneMaterials::HasDetails(). `by_places`: for PixelPlace smaller than a pixel,
  /// whose textures are as sharp. Errors as gl::GlProgram::Create.
  static Result<ObjectPass> Create(bool detailed, bool by_places);

  /// Draws the objects' triangle numbers into the samples. The real surfaces' numbers and depth of
  /// ShadowRatioPass::DrawSurfaces() must be in place. `within` bounds what Draw() draws. Binds
  /// textures to unit 0.
  void DrawSurfaces(const RenderTargets& targets, const SceneSurfaces& surfaces,
                    const FrameUniforms& frame, const PixelRect& within) const;

  /// Shades the surfaces of DrawSurfaces() into targets.objects(), with the `coverage` of this
  /// frame. `within`: all pixels with
  /// objects, in disjoint rectangles. Requires bound shadow maps, the sun transmittance map at unit
  /// 5, GL_DEPTH_TEST enabled and GL_CULL_FACE disabled. Binds its own textures to units 0 to 4, 6,
  /// 7, 16, 17 and 19 to 21. Afterwards depth writes are on, depth tests use GL_LESS, and the
  /// scissor test is off.
  void Draw(const RenderTargets& targets, const SceneSurfaces& surfaces,
            const CoveragePass& coverage, const SurfacePrograms& programs,
            const FrameUniforms& frame, const gl::GlTexture& environment,
            std::span<const PixelRect> within) const;

 private:
  struct IdPrograms {
    gl::GlProgram plain, textured, alpha;
  };

  IdPrograms ids_, behind_ids_;  // The latter for PixelPlace::behind.
  gl::GlProgram sort_program_;
  gl::GlVertexArray no_attributes_;
};

}  // namespace pleinair::compositor
