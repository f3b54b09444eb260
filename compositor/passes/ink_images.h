#pragma once

#include "base/error.h"
#include "compositor/surfaces/image_tiles.h"
#include "gl/framebuffer.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// What ink does to the light of a picture, per render pixel and channel, display-linear:
/// light · kept + lit + unlit. Shadows of virtual objects fall on the first two.
struct InkImages {
  gl::GlTexture kept, lit, unlit;
  gl::GlFramebuffer framebuffer;  ///< Of these three.
  ImageTiles tiles{0, 0};         ///< With ink in the current frame; the others hold no ink.

  /// Errors (system): no memory.
  static Result<InkImages> Create(int width, int height);
  /// Directs drawing to the images, with no ink in them.
  void Begin() const;
};

}  // namespace pleinair::compositor
