#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>

#include "base/error.h"
#include "gl/handle.h"

namespace pleinair::gl {

inline void DeleteTexture(GLuint id) { glDeleteTextures(1, &id); }

/// A texture with immutable storage. New textures clamp to the edge and filter linearly without
/// mip maps (multisample textures have no filter).
class GlTexture {
 public:
  /// Errors (all factories, kSystem): a size beyond the renderer's limit, out of memory.
  static Result<GlTexture> Create2D(GLenum internal_format, int width, int height, int levels = 1);
  static Result<GlTexture> Create2DArray(GLenum internal_format, int width, int height, int layers,
                                         int levels = 1);
  static Result<GlTexture> Create2DMultisample(GLenum internal_format, int width, int height,
                                               int samples);

  GlTexture() = default;

  /// Uploads a whole level of a 2D texture; rows from memory without padding.
  void Upload(GLenum format, GLenum type, const void* pixels, int level = 0);
  /// Uploads a whole level of one layer of an array.
  void UploadLayer(int layer, GLenum format, GLenum type, const void* pixels, int level = 0);
  /// Copies a level (for an array, all layers) to memory; `bytes` must be large enough. Blocks
  /// until the renderer has finished.
  void Download(GLenum format, GLenum type, std::span<std::byte> bytes, int level = 0) const;

  /// Copies a rectangle of a 2D texture to its place in memory for all of it. The rest of `bytes`
  /// is left as it is. `texel_bytes`: of format and type. Blocks as Download().
  void DownloadPart(int x, int y, int width, int height, GLenum format, GLenum type,
                    int texel_bytes, std::span<std::byte> bytes) const;

  void GenerateMipmaps();
  void SetFilter(GLenum minification, GLenum magnification);
  void SetWrap(GLenum mode);

  void Bind(int unit) const { glBindTextureUnit(static_cast<GLuint>(unit), handle_.id()); }

  GLuint id() const { return handle_.id(); }
  explicit operator bool() const { return static_cast<bool>(handle_); }
  GLenum internal_format() const { return internal_format_; }
  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }

 private:
  static Result<GlTexture> Allocate(GLenum target, GLenum internal_format, int width, int height,
                                    int layers, int levels, int samples);

  GlHandle<&DeleteTexture> handle_;
  GLenum internal_format_ = 0;
  int width_ = 0;
  int height_ = 0;
  int samples_ = 0;
};

}  // namespace pleinair::gl
