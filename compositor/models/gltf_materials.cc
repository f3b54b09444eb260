#include "compositor/models/gltf_materials.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "compositor/models/gltf_accessor.h"
#include "compositor/models/gltf_error.h"
#include "compositor/models/texture_decoder.h"

namespace pleinair::compositor {
namespace {

// Max. length of an extension's name in messages.
constexpr std::size_t kMaxNameLength = 64;

class MaterialReader {
 public:
  MaterialReader(const tinygltf::Model& gltf, const EncodedGltfImages& encoded,
                 const std::filesystem::path& file, Model* model)
      : gltf_(gltf), encoded_(encoded), file_(file), where_(file.string()), model_(*model) {}

  Result<std::vector<UvMap>> Read() {
    for (const tinygltf::Material& material : gltf_.materials) {
      PLEINAIR_RETURN_IF_ERROR(ReadMaterial(material));
    }
    model_.materials.push_back({});  // For primitives without one.
    model_.materials.back().coat.f0 = kDielectricF0;
    model_.materials.back().coat.base_share = 1.0F - kDielectricF0;
    return std::move(uv_maps_);
  }

 private:
  /// Index of a glTF texture's image.
  Result<int> PictureOf(int texture) const {
    if (!IsGltfIndex(texture, gltf_.textures.size())) {
      return GltfError(where_, "refers to a texture out of range");
    }
    const int image = gltf_.textures[static_cast<std::size_t>(texture)].source;
    if (IsGltfIndex(image, gltf_.images.size())) return image;
    return GltfError(where_, "texture " + std::to_string(texture) + " has no PNG or JPEG picture");
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
    material.double_sided = source.doubleSided;
    material.coat.f0 = kDielectricF0;
    material.coat.base_share = 1.0F - kDielectricF0;
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
    UvMap uv_map = UvMapOf(pbr.baseColorTexture);
    if (const auto& texture = pbr.metallicRoughnessTexture; texture.index >= 0) {
      const UvMap of_coat = UvMapOf(texture);
      if (material.base_color_texture < 0) uv_map = of_coat;
      if (of_coat == uv_map) {
        PLEINAIR_ASSIGN_OR_RETURN(material.metallic_roughness_texture,
                                  Texture(texture.index, false));
      } else {
        // Surfaces have only one set of texture coordinates.
        PLEINAIR_RETURN_IF_ERROR(TakeMean(texture.index, &material));
      }
    }
    uv_maps_.push_back(uv_map);
    NoteUnsupported(source, &material);
    model_.materials.push_back(std::move(material));
    return {};
  }

  static void NoteUnsupported(const tinygltf::Material& source, Material* material) {
    if (source.normalTexture.index >= 0) material->unsupported_features.insert("normal maps");
    const auto& emission = source.emissiveFactor;
    if (std::any_of(emission.begin(), emission.end(), [](double value) { return value > 0.0; })) {
      material->unsupported_features.insert("emission");
    }
    for (const auto& [extension, value] : source.extensions) {
      // It only scales the emission, which is already reported.
      if (extension == "KHR_materials_emissive_strength") continue;
      material->unsupported_features.insert(Shortened(extension));
    }
  }

  /// Shortens a name without splitting a UTF-8 character.
  static std::string Shortened(const std::string& name) {
    if (name.size() <= kMaxNameLength) return name;
    std::size_t end = kMaxNameLength;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
    return name.substr(0, end);
  }

  /// Multiplies by a texture's mean: green is roughness, blue metallic, both linear.
  Result<void> TakeMean(int texture, Material* material) {
    PLEINAIR_ASSIGN_OR_RETURN(const int image, PictureOf(texture));
    auto known = means_.find(image);
    if (known == means_.end()) {
      PLEINAIR_ASSIGN_OR_RETURN(const Image<std::uint8_t> picture, Picture(image));
      double roughness = 0.0, metallic = 0.0;
      for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) {
          roughness += picture(x, y, 1);
          metallic += picture(x, y, 2);
        }
      }
      const double scale = 1.0 / (255.0 * picture.width() * picture.height());
      known = means_
                  .emplace(image, std::array{static_cast<float>(roughness * scale),
                                             static_cast<float>(metallic * scale)})
                  .first;
    }
    material->roughness *= known->second[0];
    material->metallic *= known->second[1];
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
  std::map<int, std::array<float, 2>> means_;     ///< Mean roughness and metallic by glTF image.
  std::vector<UvMap> uv_maps_;
};

}  // namespace

Result<std::vector<UvMap>> ReadGltfMaterials(const tinygltf::Model& gltf,
                                             const EncodedGltfImages& encoded,
                                             const std::filesystem::path& file, Model* model) {
  return MaterialReader(gltf, encoded, file, model).Read();
}

}  // namespace pleinair::compositor
