#include "gl/texture.h"

#include <algorithm>
#include <string>

namespace pleinair::gl {

Result<GlTexture> GlTexture::Allocate(GLenum target, GLenum internal_format, int width, int height,
                                      int layers, int levels, int samples) {
  GLint limit = 0;
  GLint layer_limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layer_limit);
  const std::string size = std::to_string(width) + "×" + std::to_string(height);
  if (width < 1 || height < 1 || layers < 1 || width > limit || height > limit ||
      layers > layer_limit) {
    return SystemError("OpenGL",
                       "a texture of " + size + " with " + std::to_string(layers) +
                           " layers is beyond the renderer's limit of " + std::to_string(limit) +
                           "×" + std::to_string(limit) + " with " + std::to_string(layer_limit),
                       "choose a smaller size");
  }
  if (samples > 0) {
    GLint sample_limit = 0;
    glGetInternalformativ(GL_TEXTURE_2D_MULTISAMPLE, internal_format, GL_SAMPLES, 1, &sample_limit);
    if (samples > sample_limit) {
      return SystemError("OpenGL",
                         std::to_string(samples) + " samples a pixel, but the renderer gives " +
                             std::to_string(sample_limit) + " at most",
                         "choose fewer samples");
    }
  }
  while (glGetError() != GL_NO_ERROR) {
  }
  GLuint id = 0;
  glCreateTextures(target, 1, &id);
  GlTexture texture;
  texture.handle_ = GlHandle<&DeleteTexture>(id);
  if (target == GL_TEXTURE_2D_MULTISAMPLE) {
    glTextureStorage2DMultisample(id, samples, internal_format, width, height, GL_TRUE);
  } else if (target == GL_TEXTURE_2D_ARRAY) {
    glTextureStorage3D(id, levels, internal_format, width, height, layers);
  } else {
    glTextureStorage2D(id, levels, internal_format, width, height);
  }
  const GLenum error = glGetError();
  if (error != GL_NO_ERROR) {
    return SystemError(
        "OpenGL",
        error == GL_OUT_OF_MEMORY
            ? "no memory for a texture of " + size
            : "a texture of " + size + " was refused (GL error " + std::to_string(error) + ")",
        "choose a smaller size");
  }
  texture.internal_format_ = internal_format;
  texture.width_ = width;
  texture.height_ = height;
  texture.samples_ = samples;
  if (samples == 0) {
    texture.SetFilter(GL_LINEAR, GL_LINEAR);
    texture.SetWrap(GL_CLAMP_TO_EDGE);
  }
  return texture;
}

Result<GlTexture> GlTexture::Create2D(GLenum internal_format, int width, int height, int levels) {
  return Allocate(GL_TEXTURE_2D, internal_format, width, height, 1, levels, 0);
}

Result<GlTexture> GlTexture::Create2DArray(GLenum internal_format, int width, int height,
                                           int layers, int levels) {
  return Allocate(GL_TEXTURE_2D_ARRAY, internal_format, width, height, layers, levels, 0);
}

Result<GlTexture> GlTexture::Create2DMultisample(GLenum internal_format, int width, int height,
                                                 int samples) {
  return Allocate(GL_TEXTURE_2D_MULTISAMPLE, internal_format, width, height, 1, 1,
                  std::max(samples, 1));
}

void GlTexture::Upload(GLenum format, GLenum type, const void* pixels, int level) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(id(), level, 0, 0, std::max(width_ >> level, 1),
                      std::max(height_ >> level, 1), format, type, pixels);
}

void GlTexture::UploadLayer(int layer, GLenum format, GLenum type, const void* pixels, int level) {
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage3D(id(), level, 0, 0, layer, std::max(width_ >> level, 1),
                      std::max(height_ >> level, 1), 1, format, type, pixels);
}

void GlTexture::Download(GLenum format, GLenum type, std::span<std::byte> bytes, int level) const {
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(id(), level, format, type, static_cast<GLsizei>(bytes.size()), bytes.data());
}

void GlTexture::DownloadPart(int x, int y, int width, int height, GLenum format, GLenum type,
                             int texel_bytes, std::span<std::byte> bytes) const {
  if (width == 0 || height == 0) return;
  const auto first = (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(x)) *
                     static_cast<std::size_t>(texel_bytes);
  const std::span<std::byte> part = bytes.subspan(first);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_PACK_ROW_LENGTH, width_);
  glGetTextureSubImage(id(), 0, x, y, 0, width, height, 1, format, type,
                       static_cast<GLsizei>(part.size()), part.data());
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
}

void GlTexture::GenerateMipmaps() { glGenerateTextureMipmap(id()); }

void GlTexture::SetFilter(GLenum minification, GLenum magnification) {
  glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minification));
  glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, static_cast<GLint>(magnification));
}

void GlTexture::SetWrap(GLenum mode) {
  glTextureParameteri(id(), GL_TEXTURE_WRAP_S, static_cast<GLint>(mode));
  glTextureParameteri(id(), GL_TEXTURE_WRAP_T, static_cast<GLint>(mode));
}

}  // namespace pleinair::gl
