#include "compositor/models/gltf_materials.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "base/vector.h"
#include "compositor/models/gltf_accessor.h"
#include "compositor/models/gltf_error.h"
#include "compositor/models/texture_decoder.h"

namespace pleinair::compositor {
namespace {

// Max. scale of a normal map. The shader clips steeper bumps anyway.
constexpr double kMaxBumpScale = 100.0;
// Refractive index of a material without one (glTF 2.0, appendix B.2); that of diamond.
constexpr double kDefaultIor = 1.5, kMaxIor = 2.42;
// Both faces of a clear pane reflect 4 %.
constexpr double kPaneTransmittance = 0.92;
// Ten times the sun's disc.
constexpr double kMaxLuminance_cd_m2 = 2e10;
constexpr const char* kTransmissionBesideEmission =
    "textures of diffuse transmission beside those of emission";
constexpr const char* kThirdSet = "a third set of texture coordinates";
// Ignored textures of layers: only the layers' factors count.
constexpr std::array<const char*, 4> kIgnoredTextures = {
    "specularColorTexture", "sheenColorTexture", "sheenRoughnessTexture", "clearcoatNormalTexture"};

class MaterialReader {
 public:
  MaterialReader(const tinygltf::Model& gltf, const EncodedGltfImages& encoded,
                 const std::filesystem::path& file, Model* model)
      : gltf_(gltf), encoded_(encoded), file_(file), where_(file.string()), model_(*model) {}

  Result<std::vector<MaterialUvs>> Read() {
    for (const tinygltf::Material& material : gltf_.materials) {
      PLEINAIR_RETURN_IF_ERROR(ReadMaterial(material));
    }
    model_.materials.push_back({});  // For primitives without one.
    model_.materials.back().coat.f0 = kDielectricF0;
    model_.materials.back().coat.base_share = 1.0F - kDielectricF0;
    return std::move(uvs_);
  }

 private:
  /// Index of a glTF texture's image.
  Result<int> PictureOf(int texture) const {
    if (!IsGltfIndex(texture, gltf_.textures.size())) {
      return GltfError(where_, "refers to a texture out of range");
    }
    const tinygltf::Texture& source = gltf_.textures[static_cast<std::size_t>(texture)];
    int image = source.source;
    if (const auto webp = source.extensions.find("EXT_texture_webp");
        DecodesWebp() && webp != source.extensions.end()) {
      const tinygltf::Value& index = GltfField(webp->second, "source");
      if (index.IsInt()) image = index.GetNumberAsInt();
    }
    if (IsGltfIndex(image, gltf_.images.size())) return image;
    return GltfError(where_,
                     "texture " + std::to_string(texture) + " has no PNG, JPEG or WebP picture");
  }

  /// Decodes an image.
  Result<Image<std::uint8_t>> Picture(int image) const {
    const tinygltf::Image& source = gltf_.images[static_cast<std::size_t>(image)];
    const std::string name = where_ + ", image " + std::to_string(image);
    std::span<const std::byte> bytes;
    if (source.bufferView >= 0) {
      PLEINAIR_ASSIGN_OR_RETURN(bytes, GltfViewBytes(gltf_, source.bufferView, name));
    } else if (const auto found = encoded_.find(image); found != encoded_.end()) {
      bytes = std::as_bytes(std::span(found->second));
    } else {
      return InputError((file_.parent_path() / source.uri).string(), "texture does not exist",
                        "put it beside the model " + where_);
    }
    return DecodeTexture(bytes, name);
  }

  /// Index into the model's textures for a glTF texture's image. Colors are decoded from sRGB,
  /// other values are not. An image with both uses is therefore stored twice.
  Result<int> Texture(int texture, bool color = true) {
    PLEINAIR_ASSIGN_OR_RETURN(const int image, PictureOf(texture));
    if (const auto known = textures_.find({image, color}); known != textures_.end()) {
      return known->second;
    }
    PLEINAIR_ASSIGN_OR_RETURN(auto pixels, Picture(image));
    model_.textures.push_back(std::move(pixels));
    const int index = static_cast<int>(model_.textures.size()) - 1;
    textures_.emplace(std::pair{image, color}, index);
    return index;
  }

  Result<void> ReadMaterial(const tinygltf::Material& source) {
    Material material;
    material.name = source.name;
    material.alpha = source.alphaMode == "MASK"    ? Material::Alpha::kCutout
                     : source.alphaMode == "BLEND" ? Material::Alpha::kBlended
                                                   : Material::Alpha::kIgnored;
    // Above 1 everything is cut out (glTF 2.0, 3.9.4), however far above.
    material.alpha_cutoff = 2.0F * Clamped(source.alphaCutoff / 2.0);
    const auto& pbr = source.pbrMetallicRoughness;
    if (pbr.baseColorFactor.size() == 4) material.opacity = Clamped(pbr.baseColorFactor[3]);
    for (std::size_t c = 0; c < 3 && c < pbr.baseColorFactor.size(); ++c) {
      material.base_color[c] = Clamped(pbr.baseColorFactor[c]);
    }
    material.metallic = Clamped(pbr.metallicFactor);
    material.roughness = Clamped(pbr.roughnessFactor);
    if (pbr.baseColorTexture.index >= 0) {
      PLEINAIR_ASSIGN_OR_RETURN(material.base_color_texture, Texture(pbr.baseColorTexture.index));
    }
    MaterialUvs uvs{FirstMap(source), {}};
    if (const int texture = pbr.metallicRoughnessTexture.index; texture >= 0) {
      if (const auto coordinates = CoordinatesIn(&uvs, UvMapOf(pbr.metallicRoughnessTexture))) {
        PLEINAIR_ASSIGN_OR_RETURN(material.metallic_roughness_texture, Texture(texture, false));
        material.detail.metallic_roughness_coordinates = *coordinates;
      } else {
        PLEINAIR_RETURN_IF_ERROR(TakeMean(texture, &material));
      }
    }
    PLEINAIR_RETURN_IF_ERROR(ReadNormalMap(source, &uvs, &material));
    PLEINAIR_RETURN_IF_ERROR(ReadEmission(source, &uvs, &material));
    material.detail.unlit = source.extensions.contains("KHR_materials_unlit");
    PLEINAIR_RETURN_IF_ERROR(ReadLayers(source, &material));
    PLEINAIR_RETURN_IF_ERROR(ReadDiffuseTransmission(source, &uvs, &material));
    uvs_.push_back(uvs);
    NoteUnsupported(source, &material);
    model_.materials.push_back(std::move(material));
    return {};
  }

  /// A number of an extension; `otherwise` where it or the extension is missing.
  static double NumberOf(const tinygltf::Material& source, const char* extension, const char* key,
                         double otherwise) {
    const auto found = source.extensions.find(extension);
    if (found == source.extensions.end()) return otherwise;
    const tinygltf::Value& value = GltfField(found->second, key);
    return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
  }

  /// A color of an extension, as above.
  static std::array<float, 3> ColorOf(const tinygltf::Material& source, const char* extension,
                                      const char* key, const std::array<float, 3>& otherwise) {
    const auto found = source.extensions.find(extension);
    if (found == source.extensions.end()) return otherwise;
    const tinygltf::Value& value = GltfField(found->second, key);
    if (!value.IsArray() || value.ArrayLen() != 3) return otherwise;
    std::array<float, 3> color{};
    for (int c = 0; c < 3; ++c) {
      if (value.Get(c).IsNumber()) {
        color[static_cast<std::size_t>(c)] = Clamped(value.Get(c).GetNumberAsDouble());
      }
    }
    return color;
  }

  /// Mean of a channel of an extension's texture, 0…1; 1 where it is missing.
  Result<float> MeanOf(const tinygltf::Material& source, const char* extension, const char* key,
                       std::size_t channel) {
    const auto found = source.extensions.find(extension);
    if (found == source.extensions.end()) return 1.0F;
    const tinygltf::Value& index = GltfField(GltfField(found->second, key), "index");
    if (!index.IsInt()) return 1.0F;
    PLEINAIR_ASSIGN_OR_RETURN(const auto means, MeansOf(index.GetNumberAsInt()));
    return means[channel];
  }

  /// Mean of each channel of a texture, 0…1, without decoding sRGB. Alpha is 1 where it is missing.
  Result<std::array<float, 4>> MeansOf(int texture) {
    PLEINAIR_ASSIGN_OR_RETURN(const int image, PictureOf(texture));
    if (const auto known = means_.find(image); known != means_.end()) return known->second;
    PLEINAIR_ASSIGN_OR_RETURN(const Image<std::uint8_t> picture, Picture(image));
    const int channels = std::min(picture.channels(), 4);
    std::array<double, 4> sums{};
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        for (int c = 0; c < channels; ++c) sums[static_cast<std::size_t>(c)] += picture(x, y, c);
      }
    }
    const double scale = 1.0 / (255.0 * picture.width() * picture.height());
    std::array<float, 4> means{1.0F, 1.0F, 1.0F, 1.0F};
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
      means[c] = static_cast<float>(sums[c] * scale);
    }
    means_.emplace(image, means);
    return means;
  }

  /// KHR_materials_ior, _specular, _clearcoat, _sheen and _transmission. Textures of numbers are
  /// replaced by their mean, those of kIgnoredTextures left out.
  Result<void> ReadLayers(const tinygltf::Material& source, Material* material) {
    MaterialLayers& layers = material->detail.layers;
    // KHR_materials_ior: normal reflectance ((n − 1) / (n + 1))². An index of 0 means 1.
    const double index = NumberOf(source, "KHR_materials_ior", "ior", kDefaultIor);
    const double root = index > 1.0
                            ? (std::min(index, kMaxIor) - 1.0) / (std::min(index, kMaxIor) + 1.0)
                            : (index == 0.0 ? 1.0 : 0.0);
    PLEINAIR_ASSIGN_OR_RETURN(const float specular,
                              MeanOf(source, "KHR_materials_specular", "specularTexture", 3));
    const double strength =
        specular * Clamped(NumberOf(source, "KHR_materials_specular", "specularFactor", 1.0));
    material->coat.f0 = index == kDefaultIor && strength == 1.0
                            ? kDielectricF0
                            : static_cast<float>(root * root * strength);
    material->coat.base_share = 1.0F - material->coat.f0;
    layers.coat_tint =
        ColorOf(source, "KHR_materials_specular", "specularColorFactor", layers.coat_tint);
    PLEINAIR_ASSIGN_OR_RETURN(const float coat,
                              MeanOf(source, "KHR_materials_clearcoat", "clearcoatTexture", 0));
    layers.clearcoat =
        coat * Clamped(NumberOf(source, "KHR_materials_clearcoat", "clearcoatFactor", 0.0));
    PLEINAIR_ASSIGN_OR_RETURN(const float coat_roughness, MeanOf(source, "KHR_materials_clearcoat",
                                                                 "clearcoatRoughnessTexture", 1));
    layers.clearcoat_roughness =
        coat_roughness *
        Clamped(NumberOf(source, "KHR_materials_clearcoat", "clearcoatRoughnessFactor", 0.0));
    if (layers.clearcoat == 0.0F) layers.clearcoat_roughness = 0.0F;
    layers.sheen_color =
        ColorOf(source, "KHR_materials_sheen", "sheenColorFactor", layers.sheen_color);
    if (layers.sheen_color != std::array<float, 3>{}) {
      layers.sheen_roughness =
          Clamped(NumberOf(source, "KHR_materials_sheen", "sheenRoughnessFactor", 0.0));
    }
    return ReadTransmission(source, material);
  }

  /// Share of a surface that is no metal; its texture counts by its mean.
  Result<float> NotMetal(const tinygltf::Material& source, const Material& material) {
    if (material.metallic_roughness_texture < 0) return 1.0F - material.metallic;
    PLEINAIR_ASSIGN_OR_RETURN(const auto means,
                              MeansOf(source.pbrMetallicRoughness.metallicRoughnessTexture.index));
    return 1.0F - material.metallic * means[2];
  }

  /// A thin sheet hides what it does not transmit; it transmits its base color's luminance.
  Result<void> ReadTransmission(const tinygltf::Material& source, Material* material) {
    PLEINAIR_ASSIGN_OR_RETURN(
        const float mean, MeanOf(source, "KHR_materials_transmission", "transmissionTexture", 0));
    PLEINAIR_ASSIGN_OR_RETURN(const float not_metal, NotMetal(source, *material));
    const double factor =
        mean * Clamped(NumberOf(source, "KHR_materials_transmission", "transmissionFactor", 0.0)) *
        not_metal;
    if (factor <= 0.0) return {};
    const auto& [r, g, b] = material->base_color;
    const double hidden = 1.0 - factor * kPaneTransmittance * Luminance(LinearRgb{r, g, b});
    if (material->alpha == Material::Alpha::kIgnored) material->opacity = 1.0F;
    material->opacity *= static_cast<float>(hidden);
    material->alpha = Material::Alpha::kBlended;
    return {};
  }

  /// KHR_materials_diffuse_transmission: the factor moves light from the base to the other side.
  Result<void> ReadDiffuseTransmission(const tinygltf::Material& source, MaterialUvs* uvs,
                                       Material* material) {
    constexpr const char* kName = "KHR_materials_diffuse_transmission";
    PLEINAIR_ASSIGN_OR_RETURN(const float mean,
                              MeanOf(source, kName, "diffuseTransmissionTexture", 3));
    PLEINAIR_ASSIGN_OR_RETURN(const float not_metal, NotMetal(source, *material));
    const float factor =
        mean * not_metal * Clamped(NumberOf(source, kName, "diffuseTransmissionFactor", 0.0));
    if (factor <= 0.0F) return {};
    if (material->detail.emission.texture >= 0) {  // One texture unit serves both.
      material->unsupported_features.insert(kTransmissionBesideEmission);
      return {};
    }
    DiffuseTransmission& transmission = material->detail.transmission;
    transmission.color =
        ColorOf(source, kName, "diffuseTransmissionColorFactor", {1.0F, 1.0F, 1.0F});
    for (float& value : transmission.color) value *= factor * material->coat.base_share;
    for (float& value : material->base_color) value *= 1.0F - factor;
    const tinygltf::TextureInfo info =
        TextureInfoOf(GltfField(source.extensions.at(kName), "diffuseTransmissionColorTexture"));
    if (info.index < 0) return {};
    const auto coordinates = CoordinatesIn(uvs, UvMapOf(info));
    if (!coordinates) {
      material->unsupported_features.insert(kThirdSet);
      return {};
    }
    PLEINAIR_ASSIGN_OR_RETURN(transmission.texture, Texture(info.index));
    transmission.coordinates = *coordinates;
    return {};
  }

  /// The map of the first texture that the material has.
  static UvMap FirstMap(const tinygltf::Material& source) {
    const auto& pbr = source.pbrMetallicRoughness;
    if (pbr.baseColorTexture.index >= 0) return UvMapOf(pbr.baseColorTexture);
    if (pbr.metallicRoughnessTexture.index >= 0) return UvMapOf(pbr.metallicRoughnessTexture);
    if (source.normalTexture.index >= 0) return UvMapOf(source.normalTexture);
    return UvMapOf(source.emissiveTexture);
  }

  Result<void> ReadNormalMap(const tinygltf::Material& source, MaterialUvs* uvs,
                             Material* material) {
    const tinygltf::NormalTextureInfo& texture = source.normalTexture;
    if (texture.index < 0) return {};
    const auto coordinates = CoordinatesIn(uvs, UvMapOf(texture));
    if (!coordinates) {
      material->unsupported_features.insert(kThirdSet);
      return {};
    }
    NormalMap& map = material->detail.normal_map;
    PLEINAIR_ASSIGN_OR_RETURN(map.texture, Texture(texture.index, false));
    map.scale = static_cast<float>(std::clamp(texture.scale, -kMaxBumpScale, kMaxBumpScale));
    map.coordinates = *coordinates;
    return {};
  }

  /// KHR_materials_emissive_strength: factor times strength is the luminance in cd/m².
  Result<void> ReadEmission(const tinygltf::Material& source, MaterialUvs* uvs,
                            Material* material) {
    Emission& emission = material->detail.emission;
    const double strength =
        NumberOf(source, "KHR_materials_emissive_strength", "emissiveStrength", 1.0);
    for (std::size_t c = 0; c < 3 && c < source.emissiveFactor.size(); ++c) {
      const double luminance = strength * source.emissiveFactor[c];
      if (luminance > 0.0) {  // Not NaN.
        emission.luminance_cd_m2[c] = static_cast<float>(std::min(luminance, kMaxLuminance_cd_m2));
      }
    }
    const tinygltf::TextureInfo& texture = source.emissiveTexture;
    if (texture.index < 0 || emission.luminance_cd_m2 == std::array<float, 3>{}) return {};
    const auto coordinates = CoordinatesIn(uvs, UvMapOf(texture));
    if (!coordinates) {
      material->unsupported_features.insert(kThirdSet);
      emission = {};
      return {};
    }
    PLEINAIR_ASSIGN_OR_RETURN(emission.texture, Texture(texture.index));
    emission.coordinates = *coordinates;
    return {};
  }

  static void NoteUnsupported(const tinygltf::Material& source, Material* material) {
    static const std::set<std::string> kSupported = {"KHR_materials_emissive_strength",
                                                     "KHR_materials_unlit",
                                                     "KHR_materials_ior",
                                                     "KHR_materials_specular",
                                                     "KHR_materials_sheen",
                                                     "KHR_materials_clearcoat",
                                                     "KHR_materials_transmission",
                                                     "KHR_materials_diffuse_transmission"};
    for (const auto& entry : source.extensions) {
      const std::string& extension = entry.first;
      const tinygltf::Value& value = entry.second;
      if (!kSupported.contains(extension)) {
        material->unsupported_features.insert(ShortName(extension));
      } else if (std::ranges::any_of(kIgnoredTextures, [&](const char* key) {
                   return GltfField(value, key).IsObject();
                 })) {
        material->unsupported_features.insert("textures of layers");
      }
    }
  }

  /// Multiplies by a texture's mean: green is roughness, blue metallic, both linear.
  Result<void> TakeMean(int texture, Material* material) {
    PLEINAIR_ASSIGN_OR_RETURN(const auto means, MeansOf(texture));
    material->roughness *= means[1];
    material->metallic *= means[2];
    return {};
  }

  static float Clamped(double value) {
    return value > 0.0 ? static_cast<float>(std::min(value, 1.0)) : 0.0F;  // Also NaN.
  }

  const tinygltf::Model& gltf_;
  const EncodedGltfImages& encoded_;
  const std::filesystem::path& file_;
  std::string where_;
  Model& model_;
  std::map<std::pair<int, bool>, int> textures_;  ///< Model's texture by glTF image and use.
  std::map<int, std::array<float, 4>> means_;     ///< Means of the channels, by glTF image.
  std::vector<MaterialUvs> uvs_;
};

}  // namespace

Result<std::vector<MaterialUvs>> ReadGltfMaterials(const tinygltf::Model& gltf,
                                                   const EncodedGltfImages& encoded,
                                                   const std::filesystem::path& file,
                                                   Model* model) {
  return MaterialReader(gltf, encoded, file, model).Read();
}

}  // namespace pleinair::compositor
