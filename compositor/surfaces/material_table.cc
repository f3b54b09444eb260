#include "compositor/surfaces/material_table.h"

#include <algorithm>

#include "compositor/surfaces/texture_rows.h"

namespace pleinair::compositor {

void MaterialTable::Set(std::size_t surface, const Material& material,
                        const glm::mat4& marker_from_lit) {
  const std::size_t first = kTexelsPerSurface * surface;
  texels_.resize(std::max(texels_.size(), first + kTexelsPerSurface));
  const auto& [r, g, b] = material.base_color;
  texels_[first] = {r, g, b, material.metallic};
  texels_[first + 1] = {material.roughness, material.coat.f0, material.coat.base_share, 0.0F};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      texels_[first + 2 + static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          marker_from_lit[column][row];
    }
  }
}

Result<void> MaterialTable::Upload() {
  return UploadRows(texels_, kSurfacesPerRow * kTexelsPerSurface, GL_RGBA32F, GL_RGBA, GL_FLOAT,
                    &texture_);
}

}  // namespace pleinair::compositor
