#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "base/error.h"
#include "compositor/models/model.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// Materials and places of the virtual objects' surfaces in a texture, for shaders that learn from
/// a picture of numbers what each pixel shows (shaders/material_table.glsl). Textures are no part
/// of it: they are read where triangles are drawn. Needs a current OpenGL context; move-only.
class MaterialTable {
 public:
  /// How it is laid out: twins of shaders/visibility_buffer_layout.glsl.
  static constexpr int kTexelsPerSurface = 5, kSurfacesPerRow = 819;

  /// What `surface`, from 0 on, is made of, and where it stands: marker from where it was lit.
  void Set(std::size_t surface, const Material& material, const glm::mat4& marker_from_lit);
  /// Hands what was Set() to the shaders. Errors (system): more surfaces than a texture holds (6
  /// million with llvmpipe), no memory.
  Result<void> Upload();

  void Bind(int unit) const { texture_.Bind(unit); }

 private:
  std::vector<std::array<float, 4>> texels_;
  gl::GlTexture texture_;
};

}  // namespace pleinair::compositor
