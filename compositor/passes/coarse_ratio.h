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
  /// For the render targets of `camera`. `blended`: SceneMaterials::HasBlended(). Errors as
  /// RenderTargets::Create().
  static Result<CoarseRatio> Create(const RenderCamera& camera, bool blended);

  /// Max. difference of adjacent grid values that are interpolated. It bounds the error of the
  /// ratio on surfaces as wide as a grid pixel: two 8-bit steps at white (sRGB), fewer at darker
  /// values. A thinner surface may lose up to its whole change of sky light.
  static constexpr float kMaxJump = 0.018F;

  /// Draws ShadowRatioPass::DrawSky() on the grid, for the `frame` and `view` of the render image.
  /// Returns the tiles among `wanted` (render image) whose adjacent values differ by more than
  /// kMaxJump: they need the full resolution. Afterwards GL_DEPTH_TEST and GL_CULL_FACE are
  /// disabled.
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
