#pragma once

#include <span>

#include "base/error.h"
#include "compositor/surfaces/image_tiles.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"

namespace pleinair::compositor {

/// What a frame shows where real surfaces that are out of focus cover virtual ones in part. The
/// frame has mixed the occluder and the background there. Both are estimated from the nearest
/// pixels that show one of them alone. Needs a current OpenGL context; move-only.
class RealOccluders {
 public:
  RealOccluders() = default;
  /// For render images of this size. Errors as gl::GlTexture::Create2D() and
  /// gl::GlProgram::Create().
  static Result<RealOccluders> Create(int width, int height);

  /// Estimates both. `share`: LensViews::occluder_share(). Requires
  /// CameraPicture::BindForShading(2, 3, 4).
  void Estimate(const gl::GlTexture& share, std::span<const PixelRect> within);

  /// Display-linear light of the background, and the share of the lens that occluders cover.
  const gl::GlTexture& background() const { return background_; }
  /// Display-linear light of the occluders; black where there is no pixel that shows them alone.
  const gl::GlTexture& occluders() const { return occluders_; }

 private:
  gl::GlTexture frame_, background_, occluders_;
  gl::GlFramebuffer target_;
  gl::GlProgram program_;
  gl::GlVertexArray no_attributes_;
};

}  // namespace pleinair::compositor
