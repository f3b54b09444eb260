#pragma once

#include <functional>
#include <span>

#include "base/error.h"
#include "compositor/lens/pinhole_image.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/render_targets.h"
#include "compositor/surfaces/image_tiles.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "shadows/light_window.h"

namespace pleinair::compositor {

/// Draws the objects alone into the render targets.
struct ObjectDrawing {
  std::function<void()> draw;  ///< Their numbers and depth.
  /// Their colors after `draw`, within disjoint rectangles.
  std::function<void(std::span<const PixelRect>)> shade;
};

/// Copies the drawn virtual image into memory, with the distances of its surfaces. Needs a current
/// OpenGL context; move-only.
class PinholeCapture {
 public:
  PinholeCapture() = default;
  /// For render images of this size. Errors as gl::GlTexture::Create2D() and
  /// gl::GlProgram::Create().
  static Result<PinholeCapture> Create(int width, int height);

  /// Copies `targets`. `within`: all pixels that matter, in disjoint rectangles.
  PinholeImage Capture(const RenderTargets& targets, const shadows::View& view,
                       std::span<const PixelRect> within) const;
  /// Adds the objects that real surfaces hide, where a lens may see past the edges of these. The
  /// contents of `targets` are lost.
  void AddHidden(const RenderTargets& targets, const shadows::View& view,
                 std::span<const PixelRect> within, const ObjectDrawing& objects,
                 PinholeImage* image) const;
  /// Copies `targets`, which `draw` draws within the tiles with what lies behind the nearest
  /// surfaces. `max_dioptres`: BehindNearest::dioptres.
  HiddenImage CaptureBehind(const RenderTargets& targets, const shadows::View& view,
                            const ImageTiles& tiles, const Image<float>& max_dioptres,
                            const std::function<void(const BehindNearest&)>& draw);

 private:
  /// Draws object_parts_, too.
  Image<float> Dioptres(const RenderTargets& targets, const shadows::View& view,
                        std::span<const PixelRect> within) const;

  gl::GlTexture dioptres_, object_parts_, behind_;
  gl::GlFramebuffer target_;
  gl::GlProgram program_;
  gl::GlVertexArray no_attributes_;
};

}  // namespace pleinair::compositor
