#pragma once

#include <epoxy/gl.h>

#include <vector>

#include "base/error.h"
#include "gl/handle.h"
#include "gl/texture.h"

namespace pleinair::gl {

inline void DeleteFramebuffer(GLuint id) { glDeleteFramebuffers(1, &id); }

/// A texture, or one layer of it, to draw into.
struct Attachment {
  const GlTexture* texture = nullptr;
  int level = 0;
  int layer = -1;  ///< -1: the whole texture; of an array all layers, chosen by gl_Layer.
};

struct FramebufferAttachments {
  std::vector<Attachment> colors = {};  ///< Drawn by fragment outputs 0, 1, … in this order.
  Attachment depth = {};                ///< Depth or depth-stencil; none when the texture is null.
};

/// A set of textures to draw into. Does not own them.
class GlFramebuffer {
 public:
  /// Errors (kSystem): the renderer cannot draw into this combination of formats.
  static Result<GlFramebuffer> Create(const FramebufferAttachments& attachments);

  GlFramebuffer() = default;

  /// Draws go here from now on; the viewport becomes the whole picture.
  void Bind() const;
  /// Clears one color attachment.
  void ClearColor(int index, float r, float g, float b, float a) const;
  /// The same of unsigned integers, all channels.
  void ClearUnsigned(int index, unsigned value) const;
  void ClearDepth(float depth) const;
  /// Copies color 0 (resolving samples) and, where asked for, depth to `target` of the same size.
  void BlitTo(const GlFramebuffer& target, GLbitfield mask = GL_COLOR_BUFFER_BIT) const;
  /// Reads a color attachment; rows bottom-up as GL has them, without padding.
  void ReadPixels(int color_index, GLenum format, GLenum type, void* pixels) const;

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
