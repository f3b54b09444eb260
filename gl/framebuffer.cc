#include "gl/framebuffer.h"

#include <algorithm>
#include <string>

#include "base/check.h"

namespace pleinair::gl {
namespace {

void Attach(GLuint framebuffer, GLenum point, const Attachment& attachment) {
  if (attachment.layer >= 0) {
    glNamedFramebufferTextureLayer(framebuffer, point, attachment.texture->id(), attachment.level,
                                   attachment.layer);
  } else {
    glNamedFramebufferTexture(framebuffer, point, attachment.texture->id(), attachment.level);
  }
}

}  // namespace

Result<GlFramebuffer> GlFramebuffer::Create(const FramebufferAttachments& attachments) {
  GLuint id = 0;
  glCreateFramebuffers(1, &id);
  GlFramebuffer framebuffer;
  framebuffer.handle_ = GlHandle<&DeleteFramebuffer>(id);
  std::vector<GLenum> draw_buffers;
  const Attachment* any = nullptr;
  for (const Attachment& color : attachments.colors) {
    const GLenum point = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(draw_buffers.size());
    Attach(id, point, color);
    draw_buffers.push_back(point);
    any = &color;
  }
  if (attachments.depth.texture != nullptr) {
    const GLenum format = attachments.depth.texture->internal_format();
    const bool stencil = format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
    Attach(id, stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT, attachments.depth);
    any = &attachments.depth;
  }
  CHECK_NE(any, nullptr);
  framebuffer.width_ = std::max(any->texture->width() >> any->level, 1);
  framebuffer.height_ = std::max(any->texture->height() >> any->level, 1);
  glNamedFramebufferDrawBuffers(id, static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
  const GLenum status = glCheckNamedFramebufferStatus(id, GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    return SystemError("OpenGL",
                       "the renderer cannot draw into this combination of images (status " +
                           std::to_string(status) + ")");
  }
  return framebuffer;
}

void GlFramebuffer::Bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, id());
  glViewport(0, 0, width_, height_);
}

void GlFramebuffer::ClearColor(int index, float r, float g, float b, float a) const {
  const float color[] = {r, g, b, a};
  glClearNamedFramebufferfv(id(), GL_COLOR, index, color);
}

void GlFramebuffer::ClearUnsigned(int index, unsigned value) const {
  const GLuint all[] = {value, value, value, value};
  glClearNamedFramebufferuiv(id(), GL_COLOR, index, all);
}

void GlFramebuffer::ClearDepth(float depth) const {
  glClearNamedFramebufferfv(id(), GL_DEPTH, 0, &depth);
}

void GlFramebuffer::BlitTo(const GlFramebuffer& target, GLbitfield mask) const {
  glBlitNamedFramebuffer(id(), target.id(), 0, 0, width_, height_, 0, 0, target.width_,
                         target.height_, mask, GL_NEAREST);
}

void GlFramebuffer::ReadPixels(int color_index, GLenum format, GLenum type, void* pixels) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, id());
  glNamedFramebufferReadBuffer(id(), GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(color_index));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, format, type, pixels);
}

void GlFramebuffer::ReadRectangle(int x, int y, int width, int height, GLenum format, GLenum type,
                                  int row_pixels, void* pixels) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, id());
  glNamedFramebufferReadBuffer(id(), GL_COLOR_ATTACHMENT0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_PACK_ROW_LENGTH, row_pixels);
  glReadPixels(x, y, width, height, format, type, pixels);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
}

}  // namespace pleinair::gl
