#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "base/error.h"
#include "compositor/models/leaf_material.h"
#include "compositor/models/model.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// Material table: materials and transforms of the virtual objects' surfaces in a texture, for
/// shaders that read the visibility buffer (shaders/material_table.glsl). It has no textures,
/// because the pass that draws the triangles samples them. Needs a current OpenGL context;
/// move-only.
class MaterialTable {
 public:
  /// Layout; twins of shaders/visibility_buffer_layout.glsl.
  static constexpr int kTexelsPerSurface = 11, kSurfacesPerRow = 512;

  /// Sets the material of `surface` (from 0), how the light changes its colors, and its transform:
  /// marker from where it was lit.
  void Set(std::size_t surface, const Material& material, const LeafTints& tints,
           const glm::mat4& marker_from_lit);
  /// Uploads the entries for the shaders. Errors (system): more surfaces than a texture holds (6
  /// million with llvmpipe), no memory.
  Result<void> Upload();

  void Bind(int unit) const { texture_.Bind(unit); }

 private:
  std::vector<std::array<float, 4>> texels_;
  gl::GlTexture texture_;
};

}  // namespace pleinair::compositor
