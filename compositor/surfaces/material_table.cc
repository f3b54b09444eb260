#include "compositor/surfaces/material_table.h"

#include <algorithm>
#include <optional>

#include "compositor/surfaces/texture_rows.h"

namespace pleinair::compositor {

void MaterialTable::Set(std::size_t surface, const Material& material, const LeafTints& tints,
                        const glm::mat4& marker_from_lit) {
  const std::size_t first = kTexelsPerSurface * surface;
  texels_.resize(std::max(texels_.size(), first + kTexelsPerSurface));
  const auto& [r, g, b] = material.base_color;
  const auto& [sky_r, sky_g, sky_b] = tints.base_sky;
  texels_[first] = {r * sky_r, g * sky_g, b * sky_b, material.metallic};
  texels_[first + 1] = {material.roughness, material.coat.f0, material.coat.base_share,
                        material.detail.layers.clearcoat_roughness};
  const auto& [emitted_r, emitted_g, emitted_b] = material.detail.emission.luminance_cd_m2;
  texels_[first + 5] = {emitted_r, emitted_g, emitted_b, material.detail.unlit ? 1.0F : 0.0F};
  const MaterialLayers& layers = material.detail.layers;
  const auto& [tint_r, tint_g, tint_b] = layers.coat_tint;
  texels_[first + 6] = {tint_r, tint_g, tint_b, layers.clearcoat};
  const auto& [sheen_r, sheen_g, sheen_b] = layers.sheen_color;
  texels_[first + 7] = {sheen_r, sheen_g, sheen_b, layers.sheen_roughness};
  const auto& through = material.detail.transmission.color;
  const std::optional<LeafSurface>& leaf = material.detail.leaf;
  texels_[first + 8] = {through[0] * tints.through_sky[0], through[1] * tints.through_sky[1],
                        through[2] * tints.through_sky[2],
                        leaf && SurfaceShareOf(*leaf) > 0.0F ? 1.0F : 0.0F};
  texels_[first + 9] = {tints.through_sun[0], tints.through_sun[1], tints.through_sun[2],
                        leaf ? leaf->gloss : 0.0F};
  texels_[first + 10] = {tints.base_sun[0], tints.base_sun[1], tints.base_sun[2],
                         leaf ? leaf->roughness : 1.0F};
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
