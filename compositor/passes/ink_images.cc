#include "compositor/passes/ink_images.h"

#include <epoxy/gl.h>

namespace pleinair::compositor {

Result<InkImages> InkImages::Create(int width, int height) {
  InkImages images;
  for (gl::GlTexture* image : {&images.kept, &images.lit, &images.unlit}) {
    PLEINAIR_ASSIGN_OR_RETURN(*image, gl::GlTexture::Create2D(GL_RGBA16F, width, height));
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      images.framebuffer,
      gl::GlFramebuffer::Create({{{&images.kept}, {&images.lit}, {&images.unlit}}, {}}));
  images.tiles = ImageTiles(width, height);
  return images;
}

void InkImages::Begin() const {
  framebuffer.Bind();
  framebuffer.ClearColor(0, 1, 1, 1, 1);
  framebuffer.ClearColor(1, 0, 0, 0, 0);
  framebuffer.ClearColor(2, 0, 0, 0, 0);
}

}  // namespace pleinair::compositor
