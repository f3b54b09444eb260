#pragma once

#include <epoxy/gl.h>

#include <vector>

#include "base/error.h"
#include "gl/handle.h"
#include "gl/texture.h"

namespace pleinair::gl {

inline void DeleteFramebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }

/// A texture, or one layer of it, as a render target.
struct Attachment {
  const GlTexture* texture = nullptr;
  int level = 0;
  int layer = -1;  ///< -1: the whole texture; for an array all layers, selected by gl_Layer.
};

struct FramebufferAttachments {
  std::vector<Attachment> colors = {};  ///< Targets of fragment outputs 0, 1, … in this order.
  Attachment depth = {};                ///< Depth or depth-stencil; none if the texture is null.
};

/// A set of render targets. Does not own the textures.
class GlFramebuffer {
 public:
  /// Errors (kSystem): the renderer does not support this combination of formats.
  static Result<GlFramebuffer> Create(const FramebufferAttachments& attachments);

  GlFramebuffer() = default;

  /// Makes this the current framebuffer; sets the viewport to its full size.
  void Bind() const;
  /// Clears one color attachment.
  void ClearColor(int index, float r, float g, float b, float a) const;
  /// Clears one unsigned integer color attachment, all channels to `value`.
  void ClearUnsigned(int index, unsigned value) const;
  void ClearDepth(float depth) const;
  /// Copies color 0 (resolving samples) and, if `mask` has it, depth to `target` of the same size.
  void BlitTo(const GlFramebuffer& target, GLbitfield mask = GL_COLOR_BUFFER_BIT) const;
  /// Reads a color attachment; rows from the bottom, as in GL, without padding.
  void ReadPixels(int color_index, GLenum format, GLenum type, void* pixels) const;

  /// Reads a rectangle of color attachment 0 into an image with `row_pixels` pixels per row, where
  /// `pixels` is the place of the rectangle's first pixel.
  void ReadRectangle(int x, int y, int width, int height, GLenum format, GLenum type,
                     int row_pixels, void* pixels) const;

  int width() const { return width_; }
  int height() const { return height_; }
  GLuint id() const { return handle_.id(); }
  explicit operator bool() const { return static_cast<bool>(handle_); }

 private:
  GlHandle<&DeleteFramebuffer> handle_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace pleinair::gl
