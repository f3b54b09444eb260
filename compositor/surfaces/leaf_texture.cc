#include "compositor/surfaces/leaf_texture.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/srgb.h"
#include "compositor/leaf/leaf_maps.h"
#include "compositor/models/leaf_material.h"
#include "compositor/models/texture_decoder.h"

namespace pleinair::compositor {
namespace {

using LeafImage = Image<std::uint8_t>;

Result<void> ReadMapInto(const std::filesystem::path& file, const LeafImage& like,
                         const std::filesystem::path& like_file, LeafImage* image) {
  if (file.empty()) return {};
  PLEINAIR_ASSIGN_OR_RETURN(*image, ReadTexture(file));
  if (like.empty() || (image->width() == like.width() && image->height() == like.height())) {
    return {};
  }
  const auto size = [](const LeafImage& of) {
    return std::to_string(of.width()) + " x " + std::to_string(of.height());
  };
  return InputError(file.string(),
                    "has " + size(*image) + " pixels, " + like_file.string() + " " + size(like),
                    "give the maps of a leaf one size");
}

/// Codes of a texel: 6 bits for each pigment, 8 for the thickness.
std::uint32_t TexelKey(const LeafMapImages& maps, int x, int y) {
  const auto code = [](int value) { return static_cast<std::uint32_t>((value * 63 + 127) / 255); };
  std::uint32_t key = 0;
  for (int c = 0; c < 3; ++c) {
    key = key << 6U | (maps.pigment.empty() ? 63U : code(maps.pigment(x, y, c)));
  }
  return key << 8U | (maps.thickness.empty() ? 0U : maps.thickness(x, y));
}

struct TexelColors {
  std::array<std::uint8_t, 3> base{}, through{};
};

TexelColors ColorsOfTexel(const LeafSurface& leaf, const LeafMapImages& maps, std::uint32_t key) {
  const auto share = [&](unsigned shift) { return static_cast<double>(key >> shift & 63U) / 63.0; };
  const double thickness =
      maps.thickness.empty() ? 1.0 : (key & 255U) / static_cast<double>(kThicknessCodeOfOne);
  LeafSurface texel = leaf;
  scene::LeafContents& contents = texel.leaf.contents;
  contents.chlorophyll_ug_cm2 *= share(20) * thickness;
  contents.carotenoids_ug_cm2 *= share(14) * thickness;
  contents.brown *= share(8) * thickness;
  contents.anthocyanins_ug_cm2 *= thickness;
  contents.water_cm *= thickness;
  contents.dry_g_cm2 *= thickness;
  Material material;
  ApplyLeaf(texel, &material);
  TexelColors colors;
  for (std::size_t c = 0; c < 3; ++c) {
    colors.base[c] = Srgb8FromLinear(material.base_color[c]);
    colors.through[c] = Srgb8FromLinear(material.detail.transmission.color[c]);
  }
  return colors;
}

int AddTexture(LeafImage image, Model* model) {
  model->textures.push_back(std::move(image));
  return static_cast<int>(model->textures.size()) - 1;
}

/// The texture whose alpha shapes the leaf, if the material has one.
std::optional<LeafImage> AlphaOf(const Model& model, const Material& material) {
  if (material.base_color_texture < 0 || material.alpha == Material::Alpha::kIgnored) return {};
  const LeafImage& image = model.textures[static_cast<std::size_t>(material.base_color_texture)];
  if (image.channels() != 4) return {};
  return image;
}

}  // namespace

Result<LeafMapImages> ReadLeafMaps(const scene::LeafMapFiles& files) {
  LeafMapImages maps;
  LeafImage first;
  std::filesystem::path first_file;
  if (!files.structure.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(first, ReadTexture(files.structure));
    first_file = files.structure;
    LeafMaps made = MapsOfStructure(first.view());
    maps = {std::move(made.pigment), std::move(made.gloss), std::move(made.thickness)};
  }
  for (const auto& [file, image] : {std::pair(&files.pigment, &maps.pigment),
                                    {&files.gloss, &maps.gloss},
                                    {&files.thickness, &maps.thickness}}) {
    PLEINAIR_RETURN_IF_ERROR(ReadMapInto(*file, first, first_file, image));
    if (first.empty() && !image->empty()) {
      first = *image;
      first_file = *file;
    }
  }
  return maps;
}

void ApplyMappedLeaf(const LeafSurface& leaf, const LeafMapImages& maps, int material_index,
                     Model* model) {
  Material& material = model->materials[static_cast<std::size_t>(material_index)];
  const std::optional<LeafImage> alpha = AlphaOf(*model, material);
  ApplyLeaf(leaf, &material);
  material.base_color_texture = -1;
  const bool colored = !maps.pigment.empty() || !maps.thickness.empty();
  if (colored) {
    const LeafImage& like = maps.pigment.empty() ? maps.thickness : maps.pigment;
    LeafImage base(like.width(), like.height(), alpha ? 4 : 3);
    LeafImage through(like.width(), like.height(), 3);
    std::unordered_map<std::uint32_t, TexelColors> known;
    for (int y = 0; y < like.height(); ++y) {
      for (int x = 0; x < like.width(); ++x) {
        const std::uint32_t key = TexelKey(maps, x, y);
        const auto [found, is_new] = known.try_emplace(key);
        if (is_new) found->second = ColorsOfTexel(leaf, maps, key);
        for (int c = 0; c < 3; ++c) {
          base(x, y, c) = found->second.base[static_cast<std::size_t>(c)];
          through(x, y, c) = found->second.through[static_cast<std::size_t>(c)];
        }
        if (alpha) {
          base(x, y, 3) =
              (*alpha)(static_cast<int>(std::int64_t{x} * alpha->width() / like.width()),
                       static_cast<int>(std::int64_t{y} * alpha->height() / like.height()), 3);
        }
      }
    }
    material.base_color.fill(1.0F);
    material.detail.transmission.color.fill(1.0F);
    material.base_color_texture = AddTexture(std::move(base), model);
    material.detail.transmission.texture = AddTexture(std::move(through), model);
  } else if (alpha) {
    LeafImage white = *alpha;
    for (std::size_t i = 0; i < white.size(); ++i) {
      if (i % 4 != 3) white.data()[i] = 255;
    }
    material.base_color_texture = AddTexture(std::move(white), model);
  }
  if (!maps.gloss.empty()) {
    // Green is the roughness, which scales a leaf's gloss.
    LeafImage gloss(maps.gloss.width(), maps.gloss.height(), 3);
    for (int y = 0; y < gloss.height(); ++y) {
      for (int x = 0; x < gloss.width(); ++x) {
        for (int c = 0; c < 3; ++c) gloss(x, y, c) = maps.gloss(x, y, 0);
      }
    }
    material.metallic_roughness_texture = AddTexture(std::move(gloss), model);
  }
}

}  // namespace pleinair::compositor
