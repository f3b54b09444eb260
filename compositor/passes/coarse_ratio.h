#pragma once

#include "base/error.h"
#include "base/image.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/render_camera.h"
#include "compositor/passes/render_targets.h"
#include "compositor/passes/shadow_ratio_pass.h"
#include "compositor/passes/surface_programs.h"
#include "compositor/surfaces/image_tiles.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "gl/texture.h"
#include "shadows/light_window.h"

namespace pleinair::compositor {

/// The shadow-catcher ratio of changes of sky light on a coarse grid. It is smooth in most of an
/// image, so that interpolation replaces its evaluation in each pixel. Where it jumps, at
/// silhouettes, creases and contacts, tiles are refined. Needs a current OpenGL context; move-only.
class CoarseRatio {
 public:
  static constexpr int kStep_px = 4;  ///< Render pixels per pixel of the grid, along each axis.

  CoarseRatio() = default;
  /// For the render targets of `camera`. Errors as RenderTargets::Create().
  static Result<CoarseRatio> Create(const RenderCamera& camera);

  /// Max. difference of adjacent values of the grid that is interpolated, and thereby of an error:
  /// two 8-bit values at white, less below.
  static constexpr float kMaxJump = 0.018F;

  /// Draws what ShadowRatioPass::DrawSky() draws of `frame`, seen by `view`, in the tiles `wanted`
  /// of the render image at least. Returns those among them that need the full resolution. Requires
  /// GL_DEPTH_TEST disabled, and leaves it so.
  ImageTiles Draw(const ShadowRatioPass& pass, const SceneSurfaces& surfaces,
                  const SurfacePrograms& programs, const shadows::View& view,
                  const FrameUniforms& frame, const ImageTiles& wanted);
  /// 1 where nothing was drawn.
  const gl::GlTexture& ratio() const { return targets_.ratio(); }

 private:
  RenderCamera camera_;
  RenderTargets targets_;
  Image<float> values_;  // A copy of ratio().
};

}  // namespace pleinair::compositor
