#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "compositor/coverage/scene_coverage.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/render_targets.h"
#include "compositor/surfaces/image_tiles.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"

namespace pleinair::compositor {

/// Replaces what the renderer's samples show in pixels with edges by the coverage that the
/// processor computes (AntialiasingMethod::kSubpixel). Needs a current OpenGL context; move-only.
class CoveragePass {
 public:
  /// Computes and replaces nothing.
  CoveragePass() = default;
  /// `places`: of a pixel, as SamplePlaces(). `textured`: SceneMaterials::HasTextures(). Errors as
  /// gl::GlProgram::Create().
  static Result<CoveragePass> Create(int places, bool textured);

  /// Computes the coverage of the image of `targets`. `within`: all pixels drawn, in disjoint
  /// rectangles. Without memory for textures, the renderer's samples stay. They do so in frames
  /// with BehindNearest, too, which are shown through a lens alone, whose edges are soft.
  void Measure(SceneSurfaces& surfaces, const FrameUniforms& frame, const RenderTargets& targets,
               std::span<const PixelRect> within);

  /// Draws the pieces of the objects, or of the real surfaces, over those that a pass has sorted by
  /// the renderer's samples. Requires RenderTargets::BeginSorting(), depth writes with GL_ALWAYS,
  /// the VisibilityBuffer of these surfaces and, on unit 0, RenderTargets::ids(). Binds textures to
  /// units 20 and 21.
  void DrawOver(bool objects, int samples) const;

  /// Share of the drawn pixels whose coverage was computed, over all images.
  double MeasuredShare() const {
    return drawn_px_ > 0 ? static_cast<double>(measured_px_) / static_cast<double>(drawn_px_) : 0.0;
  }

 private:
  Result<void> Upload();

  std::optional<SceneCoverage> coverage_;  // Empty: none is computed.
  std::vector<PixelPieces> pieces_;
  std::vector<PixelRect> rectangles_;  // Tiles with such pixels.
  gl::GlTexture marks_, piece_texels_;
  gl::GlProgram object_program_, real_program_;
  gl::GlVertexArray no_attributes_;
  std::int64_t measured_px_ = 0, drawn_px_ = 0;  // Over all images.
};

}  // namespace pleinair::compositor
