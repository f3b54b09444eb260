#include "compositor/surfaces/scene_materials.h"

#include <algorithm>
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

/// Returns whether metallic and roughness have the texture coordinates of the base color.
bool SharesCoordinates(const TextureCoordinates& coordinates) {
  return !coordinates.second_set &&
         coordinates.matrix == std::array<float, 4>{1.0F, 0.0F, 0.0F, 1.0F} &&
         coordinates.offset == std::array<float, 2>{};
}

bool IsTranslucent(const MaterialDetail& detail) { return detail.Transmits() || detail.leaf; }

bool HasDetail(const Material& material) {
  const MaterialDetail& detail = material.detail;
  return detail.normal_map.texture >= 0 || detail.unlit || IsTranslucent(detail) ||
         detail.layers != MaterialLayers{} ||
         detail.emission.luminance_cd_m2 != std::array<float, 3>{} ||
         (material.metallic_roughness_texture >= 0 &&
          !SharesCoordinates(detail.metallic_roughness_coordinates));
}

/// Returns whether some texel is not opaque.
bool HasAlphaBelowOne(const Image<std::uint8_t>& texture) {
  if (texture.channels() != 4) return false;
  for (std::size_t i = 3; i < texture.size(); i += 4) {
    if (texture.data()[i] < 255) return true;
  }
  return false;
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
    for (const Mesh& mesh : placed.model->meshes) {
      materials.has_details_ = materials.has_details_ || !mesh.details.empty();
      const auto material = static_cast<std::size_t>(mesh.material);
      materials.has_alpha_ =
          materials.has_alpha_ ||
          (placed.model->materials[material].alpha != Material::Alpha::kIgnored &&
           std::ranges::any_of(mesh.details, [](const VertexDetail& d) { return d.color[3] < 1; }));
    }
    for (const Material& material : placed.model->materials) {
      const bool alpha = IsSeenThrough(*placed.model, material);
      materials.has_alpha_ = materials.has_alpha_ || alpha;
      materials.has_blended_ =
          materials.has_blended_ || material.alpha == Material::Alpha::kBlended;
      materials.has_textures_ = materials.has_textures_ || alpha || IsTextured(material);
      materials.has_gloss_ =
          materials.has_gloss_ || material.coat.f0 > 0.0F || material.metallic > 0.0F;
      materials.has_details_ = materials.has_details_ || HasDetail(material);
      materials.has_translucent_ = materials.has_translucent_ || IsTranslucent(material.detail);
    }
  }
  if (materials.has_details_) {
    materials.has_textures_ = true;
    materials.has_gloss_ = true;  // Bumps vary the sky's light, which comes from the environment.
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
  bind(material.detail.normal_map.texture, 2);
  const int transmission = material.detail.transmission.texture;
  bind(transmission >= 0 ? transmission : material.detail.emission.texture, 3);
}

void SceneMaterials::SetLight(LinearRgb sun, LinearRgb sky) {
  tints_.clear();
  if (!has_translucent_) return;
  const LeafIlluminant of_sun = LeafIlluminant::OfLight(sun);
  const LeafIlluminant of_sky = LeafIlluminant::OfLight(sky);
  for (std::size_t i = 0; i < scene_.size(); ++i) {
    const std::vector<Material>& materials = scene_[i].model->materials;
    for (std::size_t k = 0; k < materials.size(); ++k) {
      const auto& leaf = materials[k].detail.leaf;
      if (!leaf || scene_[i].is_phantom) continue;
      tints_[{static_cast<int>(i), static_cast<int>(k)}] = LeafTintsIn(*leaf, of_sun, of_sky);
    }
  }
}

LeafTints SceneMaterials::TintsOf(int placed_model, int material) const {
  const auto found = tints_.find({placed_model, material});
  return found == tints_.end() ? LeafTints{} : found->second;
}

bool SceneMaterials::HasHoles(int placed_model, int material) const {
  const Model& model = *Placed(placed_model).model;
  const Material& of = Of(placed_model, material);
  if (of.alpha == Material::Alpha::kIgnored) return false;
  if (of.opacity < 1.0F) return true;
  if (of.base_color_texture >= 0 &&
      HasAlphaBelowOne(model.textures[static_cast<std::size_t>(of.base_color_texture)])) {
    return true;
  }
  return std::ranges::any_of(model.meshes, [&](const Mesh& mesh) {
    return mesh.material == material &&
           std::ranges::any_of(mesh.details,
                               [](const VertexDetail& detail) { return detail.color[3] < 1.0F; });
  });
}

}  // namespace pleinair::compositor
