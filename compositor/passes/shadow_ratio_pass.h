#pragma once

#include <span>

#include "base/error.h"
#include "compositor/passes/coverage_pass.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/render_targets.h"
#include "compositor/passes/surface_programs.h"
#include "compositor/surfaces/affected_triangles.h"
#include "compositor/surfaces/image_tiles.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "gl/program.h"
#include "gl/vertex_array.h"

namespace pleinair::compositor {

/// Shadow-catcher ratio pass: how the virtual objects change the light of the real surfaces,
/// evaluated once per pixel. It draws triangle numbers per sample, classifies the pixels, and
/// shades only those that need it. Needs a current OpenGL context; move-only.
class ShadowRatioPass {
 public:
  ShadowRatioPass() = default;
  /// `blended`: SceneMaterials::HasBlended(). Errors as gl::GlProgram::Create.
  static Result<ShadowRatioPass> Create(bool blended);

  /// Draws the triangle numbers of the real surfaces into the samples, and their depth. Draw()
  /// omits surfaces that objects later cover. `within` bounds what Draw() draws.
  void DrawSurfaces(const RenderTargets& targets, const SceneSurfaces& surfaces,
                    const FrameUniforms& frame, const PixelRect& within) const;

  /// As DrawSurfaces(), for all real surfaces, also those that nothing affects. Requires
  /// SceneSurfaces::NumberAll().
  void DrawAllSurfaces(const RenderTargets& targets, const SceneSurfaces& surfaces,
                       const FrameUniforms& frame, const PixelRect& within) const;

  /// Shades the pixels of DrawSurfaces() where sky light alone changes and airlight is not
  /// noticeable. The others have the ratio 1. State as Draw().
  void DrawSky(const RenderTargets& targets, const SceneSurfaces& surfaces,
               const SurfacePrograms& programs, const FrameUniforms& frame,
               const PixelRect& within) const;

  struct ShadowOptions {
    bool assume_unmodelled = true;  ///< Composer::AssumeUnmodelledShadows().
    double margin_size_m = 0.0;     ///< Composer::SetMarkerMargin().
  };
  /// Shades the surfaces of DrawSurfaces(), after the objects are drawn, with the `coverage` of
  /// this frame. `within`: all pixels that the objects may affect, in disjoint rectangles. Requires
  /// CameraPicture::BindForShading(2, 3, 4), bound shadow maps, the sun transmittance map at unit
  /// 5, GL_DEPTH_TEST enabled and GL_CULL_FACE disabled. Binds its own textures to units 0, 1, 6,
  /// 7 and 18 to 21. Afterwards depth writes are on, depth tests use GL_LESS, and blending and the
  /// scissor test are off.
  void Draw(const RenderTargets& targets, const SceneSurfaces& surfaces,
            const CoveragePass& coverage, const SurfacePrograms& programs,
            const FrameUniforms& frame, const ShadowOptions& options,
            std::span<const PixelRect> within) const;

  /// Classification depth of pixels with at most this change. Must match
  /// shaders/visibility_buffer_layout.glsl.
  static constexpr float DepthOf(AffectedTriangles::Change change) {
    return 0.125F * static_cast<float>(change + 1);
  }

 private:
  void DrawIds(const RenderTargets& targets, const SceneSurfaces& surfaces,
               const FrameUniforms& frame, const PixelRect& within,
               SceneSurfaces::Numbered numbered) const;
  /// Classifies the pixels and clears the ratio.
  void Begin(const RenderTargets& targets, const SceneSurfaces& surfaces,
             const CoveragePass& coverage, std::span<const PixelRect> within) const;
  void Shade(const FrameUniforms& frame, const gl::GlProgram& program,
             AffectedTriangles::Change change, bool needs_airlight,
             std::span<const PixelRect> within) const;

  gl::GlProgram id_program_, behind_id_program_, sort_program_;
  gl::GlProgram linear_program_, linear_program_with_airlight_;
  gl::GlVertexArray no_attributes_;
};

/// Enables depth test and face culling for the surfaces of a scene. Open surfaces have one triangle
/// per side. Front faces are clockwise, because image rows run downwards.
void EnableSurfaceTests();

}  // namespace pleinair::compositor
