#include "compositor/surfaces/scene_materials.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "compositor/surfaces/surface_buffers.h"

namespace pleinair::compositor {
namespace {

/// Returns whether a material may have holes or transparency.
bool IsSeenThrough(const Model& model, const Material& material) {
  if (material.alpha == Material::Alpha::kIgnored) return false;
  const int texture = material.base_color_texture;
  return material.opacity < 1.0F ||
         (texture >= 0 && model.textures[static_cast<std::size_t>(texture)].channels() == 4);
}

/// Returns whether a texture varies the material.
bool IsTextured(const Material& material) {
  return material.base_color_texture >= 0 || material.metallic_roughness_texture >= 0;
}

}  // namespace

Result<SceneMaterials> SceneMaterials::Create(const std::vector<PlacedModel>& scene) {
  SceneMaterials materials;
  materials.scene_ = scene;
  PLEINAIR_ASSIGN_OR_RETURN(materials.white_, gl::GlTexture::Create2D(GL_RGBA8, 1, 1));
  constexpr std::array<std::uint8_t, 4> kWhite{255, 255, 255, 255};
  materials.white_.Upload(GL_RGBA, GL_UNSIGNED_BYTE, kWhite.data());
  for (const PlacedModel& placed : scene) {
    PLEINAIR_ASSIGN_OR_RETURN(auto textures, UploadTextures(*placed.model));
    materials.model_textures_.push_back(std::move(textures));
    if (placed.is_phantom) continue;
    for (const Material& material : placed.model->materials) {
      const bool alpha = IsSeenThrough(*placed.model, material);
      materials.has_alpha_ = materials.has_alpha_ || alpha;
      materials.has_textures_ = materials.has_textures_ || alpha || IsTextured(material);
      materials.has_gloss_ =
          materials.has_gloss_ || material.coat.f0 > 0.0F || material.metallic > 0.0F;
    }
  }
  return materials;
}

void SceneMaterials::BindTextures(int placed_model, const Material& material) const {
  const auto& textures = model_textures_[static_cast<std::size_t>(placed_model)];
  const auto bind = [&](int texture, int unit) {
    (texture >= 0 ? textures[static_cast<std::size_t>(texture)] : white_).Bind(unit);
  };
  bind(material.base_color_texture, 0);
  bind(material.metallic_roughness_texture, 1);
}

}  // namespace pleinair::compositor
