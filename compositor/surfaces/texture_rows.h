#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/error.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// Uploads `texels` to `texture` as rows of `width` elements, and pads `texels` to whole rows. Each
/// element has `texels_each` texels of the texture. If the texture has too few rows, a new one with
/// nearest-texel sampling replaces it. Errors (system): more rows than a texture holds, no memory.
/// Needs a current OpenGL context.
template <typename T>
Result<void> UploadRows(std::vector<T>& texels, int width, GLenum internal_format, GLenum format,
                        GLenum type, gl::GlTexture* texture, int texels_each = 1) {
  const auto row = static_cast<std::size_t>(width);
  const std::size_t rows = std::max<std::size_t>((texels.size() + row - 1) / row, 1);
  const std::size_t had = *texture ? static_cast<std::size_t>(texture->height()) : 0;
  texels.resize(std::max(rows, had) * row);
  if (rows > had) {
    PLEINAIR_ASSIGN_OR_RETURN(
        *texture,
        gl::GlTexture::Create2D(internal_format, texels_each * width, static_cast<int>(rows)));
    texture->SetFilter(GL_NEAREST, GL_NEAREST);
  }
  texture->Upload(format, type, texels.data());
  return {};
}

}  // namespace pleinair::compositor
