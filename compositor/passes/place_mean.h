#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/error.h"
#include "compositor/antialiasing.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/render_targets.h"
#include "compositor/surfaces/image_tiles.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"

namespace pleinair::compositor {

/// Draws the virtual image at several places of each pixel, one after another, and averages the
/// linear light (AntialiasingMethod::kReference). Needs a current OpenGL context; move-only.
class PlaceMean {
 public:
  PlaceMean() = default;
  /// Errors as gl::GlTexture::Create2D() and gl::GlProgram::Create().
  static Result<PlaceMean> Create(int width, int height, const Antialiasing& antialiasing);

  /// Calls `draw` with the frame seen through each place. `draw` has to draw targets.ratio() and
  /// targets.objects(), which have the means afterwards. `within`: all pixels drawn, in disjoint
  /// rectangles. Methods with one place draw the frame itself.
  void Draw(const RenderTargets& targets, const FrameUniforms& frame,
            std::span<const PixelRect> within,
            const std::function<void(const FrameUniforms&)>& draw) const;

  /// Pixels by which the places are farther out than a pixel's center, rounded up.
  int Spread_px() const { return places_.empty() ? 0 : 1; }

 private:
  /// Adds the pictures of one framebuffer, times `weight`, to another.
  void Copy(const gl::GlTexture& ratio, const gl::GlTexture& objects, float weight,
            std::span<const PixelRect> within) const;

  std::vector<glm::vec2> places_;  // Empty: the center alone.
  gl::GlTexture ratio_, objects_;  // Sums.
  gl::GlFramebuffer sums_;
  gl::GlProgram program_;
  gl::GlVertexArray no_attributes_;
};

}  // namespace pleinair::compositor
