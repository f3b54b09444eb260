#pragma once

#include "base/error.h"
#include "gl/framebuffer.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// What the virtual picture is drawn into, multisampled, and the two pictures it resolves to.
class RenderTargets {
 public:
  /// Errors (system): a size or format that the renderer cannot do.
  static Result<RenderTargets> Create(int width, int height);

  /// Draws go here: colour 0 is the differential ratio (cleared to 1), colour 1 the objects'
  /// premultiplied display-linear colour with coverage (cleared to 0), and depth.
  void BeginDrawing() const;
  /// Resolves the samples into ratio() and objects().
  void Resolve() const;
  /// Where one pass over ratio() and objects() may be drawn into; `back`: from there into them.
  void BeginPass(bool back) const;
  const gl::GlTexture& passed_ratio() const { return passed_ratio_; }
  const gl::GlTexture& passed_objects() const { return passed_objects_; }

  const gl::GlTexture& ratio() const { return ratio_; }
  const gl::GlTexture& objects() const { return objects_; }

 private:
  gl::GlTexture ratio_samples_, objects_samples_, depth_samples_, ratio_, objects_;
  gl::GlTexture passed_ratio_, passed_objects_;
  gl::GlFramebuffer draw_, ratio_source_, objects_source_, ratio_target_, objects_target_;
  gl::GlFramebuffer pass_, back_;
};

}  // namespace pleinair::compositor
