#include "compositor/models/obj_material.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "compositor/models/obj_lines.h"
#include "compositor/models/texture_conversion.h"

namespace pleinair::compositor {
namespace {

constexpr std::size_t kMaxMaterials = 100'000;

/// Range of a statement's numbers.
struct MtlRange {
  std::string_view keyword;
  float min, max;
};
// Colors and shares may exceed 1 by rounding. Old files write Ks beyond 1; coats reflect at most
// 8 % in any case. Ke is display-linear or cd/m².
constexpr float kOne = 1.01F;
constexpr MtlRange kMtlRanges[] = {
    {"Kd", 0.0F, kOne},  {"Ks", 0.0F, 100.0F}, {"Ke", 0.0F, 2e10F}, {"Ps", 0.0F, kOne},
    {"Ns", 0.0F, 1e6F},  {"Pr", 0.0F, kOne},   {"Pm", 0.0F, kOne},  {"Pc", 0.0F, kOne},
    {"Pcr", 0.0F, kOne}, {"d", 0.0F, kOne},    {"Tr", 0.0F, kOne},  {"illum", 0.0F, 10.0F},
    {"-bm", -1e3F, 1e3F}};
// Roughness of sheen, which MTL does not state.
constexpr float kClothRoughness = 0.3F;

/// A picture named in a material library.
struct NamedPicture {
  std::string name;
  float bump = 1.0F;  ///< Option -bm.
};

/// The statements of one material; Finish() turns them into a Material.
struct Draft {
  Material material;
  std::optional<std::array<float, 3>> specular;
  std::optional<float> exponent, roughness;
  int illumination = 2;
  bool has_color = false, has_emission = false, has_metallic = false;
  std::optional<NamedPicture> bump, normal, roughness_picture, metallic_picture;
};

class MtlParser {
 public:
  MtlParser(std::string_view text, const std::filesystem::path& file,
            const ObjCompanions& companions, Model* model)
      : lines_(WithoutByteOrderMark(text)), file_(file), companions_(companions), model_(model) {}

  Result<void> Parse() {
    while (lines_.Next()) {
      const std::string_view keyword = lines_.Word();
      if (!IsKeyword(keyword)) return Fail("holds no statement of a material library");
      if (keyword == "newmtl") {
        PLEINAIR_RETURN_IF_ERROR(Finish());
        if (model_->materials.size() >= kMaxMaterials) return Fail("has too many materials");
        draft_.emplace();
        has_material_ = true;
        draft_->material.name = std::string(lines_.Rest());
      } else if (draft_) {
        PLEINAIR_RETURN_IF_ERROR(Statement(keyword));
      }
    }
    if (!has_material_ && lines_.line_number() > 0) return Fail("defines no material");
    return Finish();
  }

 private:
  tl::unexpected<Error> Fail(std::string what) const {
    return InputError(file_.string() + ":" + std::to_string(lines_.line_number()), std::move(what),
                      "repair the material or export the model again");
  }

  static std::string_view WithoutByteOrderMark(std::string_view text) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
  }

  /// Vendors add words of their own.
  static bool IsKeyword(std::string_view word) {
    return std::all_of(word.begin(), word.end(), [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.' ||
             c == ':';
    });
  }

  /// A number of a statement or option, in its range.
  Result<float> Number(std::string_view keyword) {
    const std::string_view word = lines_.Word();
    const std::optional<float> value = ParseObjNumber(word);
    if (!value) return Fail(Quoted(word) + " is not a finite number");
    const auto* range = std::find_if(std::begin(kMtlRanges), std::end(kMtlRanges),
                                     [&](const MtlRange& of) { return of.keyword == keyword; });
    if (range == std::end(kMtlRanges) || (*value >= range->min && *value <= range->max)) {
      return *value;
    }
    return Fail(std::string(keyword) + " " + std::string(word.substr(0, 32)) + " is outside " +
                ShortNumber(range->min) + " to " +
                ShortNumber(range->max == kOne ? 1.0F : range->max));
  }

  static std::string ShortNumber(float value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", static_cast<double>(value));
    return text.data();
  }

  Result<std::array<float, 3>> Color(std::string_view keyword) {
    PLEINAIR_ASSIGN_OR_RETURN(const float red, Number(keyword));
    if (lines_.Rest().empty()) return std::array<float, 3>{red, red, red};
    PLEINAIR_ASSIGN_OR_RETURN(const float green, Number(keyword));
    PLEINAIR_ASSIGN_OR_RETURN(const float blue, Number(keyword));
    return std::array<float, 3>{red, green, blue};
  }

  Result<void> Statement(std::string_view keyword) {
    Material& material = draft_->material;
    // "Kd spectral file" and "Kd xyz …" are specified, but no program writes them.
    const bool is_color = keyword == "Kd" || keyword == "Ks";
    if (is_color && (lines_.Rest().starts_with("spectral") || lines_.Rest().starts_with("xyz"))) {
      return Fail("colours other than RGB are not supported");
    }
    if (is_color) {
      PLEINAIR_ASSIGN_OR_RETURN(auto color, Color(keyword));
      for (float& value : color) value = std::clamp(value, 0.0F, 1.0F);
      if (keyword == "Ks") {
        draft_->specular = color;
      } else {
        material.base_color = color;
        draft_->has_color = true;
      }
    } else if (keyword == "Ns") {
      PLEINAIR_ASSIGN_OR_RETURN(draft_->exponent, Number(keyword));
    } else if (keyword == "Pr") {
      PLEINAIR_ASSIGN_OR_RETURN(draft_->roughness, Number(keyword));
    } else if (keyword == "Pm") {
      PLEINAIR_ASSIGN_OR_RETURN(const float metallic, Number(keyword));
      material.metallic = std::clamp(metallic, 0.0F, 1.0F);
      draft_->has_metallic = true;
    } else if (keyword == "Pc" || keyword == "Pcr") {
      PLEINAIR_ASSIGN_OR_RETURN(const float value, Number(keyword));
      MaterialLayers& layers = material.detail.layers;
      (keyword == "Pc" ? layers.clearcoat : layers.clearcoat_roughness) =
          std::clamp(value, 0.0F, 1.0F);
    } else if (keyword == "Ps") {
      PLEINAIR_ASSIGN_OR_RETURN(auto color, Color(keyword));
      for (float& value : color) value = std::clamp(value, 0.0F, 1.0F);
      material.detail.layers.sheen_color = color;
    } else if (keyword == "Ke") {
      PLEINAIR_ASSIGN_OR_RETURN(const auto emission, Color(keyword));
      material.detail.emission.luminance_cd_m2 = emission;
      draft_->has_emission = true;
    } else if (keyword == "d" || keyword == "Tr") {
      if (lines_.Rest().starts_with("-halo")) lines_.Word();
      PLEINAIR_ASSIGN_OR_RETURN(const float value, Number(keyword));
      const float opacity = keyword == "d" ? value : 1.0F - value;
      // Programs that confuse Tr with d write 0 for opaque materials. Invisible materials do not
      // occur.
      if (opacity > 0.0F && opacity < 1.0F) {
        material.opacity = opacity;
        material.alpha = Material::Alpha::kBlended;
      }
    } else if (keyword == "illum") {
      PLEINAIR_ASSIGN_OR_RETURN(const float illumination, Number(keyword));
      draft_->illumination = static_cast<int>(illumination);
    } else if (keyword.starts_with("map_") || keyword == "bump" || keyword == "norm") {
      return PictureStatement(keyword);
    } else {
      NoteUnsupported(keyword);
    }
    return {};
  }

  Result<void> PictureStatement(std::string_view keyword) {
    if (keyword == "map_Kd" || keyword == "map_Ke") {
      PLEINAIR_ASSIGN_OR_RETURN(const NamedPicture picture, Picture());
      PLEINAIR_ASSIGN_OR_RETURN(const int texture, ColorTexture(picture.name));
      (keyword == "map_Kd" ? draft_->material.base_color_texture
                           : draft_->material.detail.emission.texture) = texture;
    } else if (keyword == "bump" || keyword == "map_bump" || keyword == "map_Bump") {
      PLEINAIR_ASSIGN_OR_RETURN(draft_->bump, Picture());
    } else if (keyword == "norm" || keyword == "map_Kn") {
      PLEINAIR_ASSIGN_OR_RETURN(draft_->normal, Picture());
    } else if (keyword == "map_Pr") {
      PLEINAIR_ASSIGN_OR_RETURN(draft_->roughness_picture, Picture());
    } else if (keyword == "map_Pm") {
      PLEINAIR_ASSIGN_OR_RETURN(draft_->metallic_picture, Picture());
    } else {
      NoteUnsupported(keyword);
    }
    return {};
  }

  void NoteUnsupported(std::string_view keyword) {
    static const std::map<std::string_view, const char*> kNames = {
        {"disp", "displacement"},
        {"refl", "pictures of surroundings"},
        {"map_refl", "pictures of surroundings"},
        {"decal", "decals"},
        {"map_d", "pictures of transparency (map_d)"},
        {"map_Ks", "pictures of gloss (map_Ks, map_Ns)"},
        {"map_Ns", "pictures of gloss (map_Ks, map_Ns)"}};
    const auto found = kNames.find(keyword);
    if (found == kNames.end()) return;
    draft_->material.unsupported_features.insert(found->second);
  }

  /// The file name is last, after options such as "-s 1 1 1"; it may contain blanks.
  Result<NamedPicture> Picture() {
    NamedPicture picture;
    const std::map<std::string_view, int> arguments = {
        {"-blendu", 1}, {"-blendv", 1}, {"-boost", 1},   {"-mm", 2},   {"-texres", 1},
        {"-clamp", 1},  {"-bm", 1},     {"-imfchan", 1}, {"-type", 1}, {"-cc", 1}};
    while (lines_.Rest().starts_with('-')) {
      const std::string_view option = lines_.Word();
      if (option == "-o" || option == "-s" || option == "-t") {
        // One to three numbers.
        for (int i = 0; i < 3; ++i) {
          ObjLines ahead(lines_.Rest());
          if (!ahead.Next() || !ParseObjNumber(ahead.Word())) break;
          lines_.Word();
        }
        continue;
      }
      const auto found = arguments.find(option);
      if (found == arguments.end()) {
        return Fail("unknown texture option " + Quoted(option));
      }
      if (option == "-bm") {
        PLEINAIR_ASSIGN_OR_RETURN(picture.bump, Number(option));
        continue;
      }
      for (int i = 0; i < found->second; ++i) lines_.Word();
    }
    picture.name = lines_.Rest();
    if (picture.name.empty()) return Fail("a picture's statement names no file");
    std::replace(picture.name.begin(), picture.name.end(), '\\', '/');
    return picture;
  }

  Result<Image<std::uint8_t>> Read(const std::string& name) const {
    return companions_.read_texture(file_.parent_path() / name);
  }

  /// Index of a picture among the model's textures, under a key of its name and use.
  template <typename Make>
  Result<int> Texture(const std::string& key, const Make& make) {
    if (const auto known = textures_.find(key); known != textures_.end()) return known->second;
    PLEINAIR_ASSIGN_OR_RETURN(Image<std::uint8_t> image, make());
    const int index = static_cast<int>(model_->textures.size());
    model_->textures.push_back(std::move(image));
    textures_.emplace(key, index);
    return index;
  }

  Result<int> ColorTexture(const std::string& name) {
    return Texture("color " + name, [&] { return Read(name); });
  }

  /// `norm` is a normal map. `bump` is one too if it looks like one, as most programs write it.
  Result<void> FinishBumps(NormalMap* map) {
    const std::optional<NamedPicture>& picture = draft_->normal ? draft_->normal : draft_->bump;
    if (!picture) return {};
    const bool is_normal_map = draft_->normal.has_value();
    const std::string key =
        (is_normal_map ? "normal " : "bump " + std::to_string(picture->bump) + " ") + picture->name;
    const auto make = [&]() -> Result<Image<std::uint8_t>> {
      PLEINAIR_ASSIGN_OR_RETURN(Image<std::uint8_t> image, Read(picture->name));
      if (is_normal_map || LooksLikeNormalMap(image)) return image;
      return NormalMapFromHeight(image, picture->bump);
    };
    PLEINAIR_ASSIGN_OR_RETURN(map->texture, Texture(key, make));
    return {};
  }

  Result<void> FinishMetallicRoughness(Material* material) {
    const auto& roughness = draft_->roughness_picture;
    const auto& metallic = draft_->metallic_picture;
    if (!roughness && !metallic) return {};
    const std::string key = "roughness " + (roughness ? roughness->name : "") + "\nmetal " +
                            (metallic ? metallic->name : "");
    const auto make = [&]() -> Result<Image<std::uint8_t>> {
      Image<std::uint8_t> green, blue;
      if (roughness) {
        PLEINAIR_ASSIGN_OR_RETURN(green, Read(roughness->name));
      }
      if (metallic) {
        PLEINAIR_ASSIGN_OR_RETURN(blue, Read(metallic->name));
      }
      return CombinedRoughnessAndMetal(green, blue);
    };
    PLEINAIR_ASSIGN_OR_RETURN(material->metallic_roughness_texture, Texture(key, make));
    if (roughness && !draft_->roughness) draft_->roughness = 1.0F;
    if (metallic && !draft_->has_metallic) material->metallic = 1.0F;
    return {};
  }

  Result<void> Finish() {
    if (!draft_) return {};
    Material& material = draft_->material;
    PLEINAIR_RETURN_IF_ERROR(FinishBumps(&material.detail.normal_map));
    PLEINAIR_RETURN_IF_ERROR(FinishMetallicRoughness(&material));
    if (material.detail.emission.texture >= 0 && !draft_->has_emission) {
      material.detail.emission.luminance_cd_m2 = {1.0F, 1.0F, 1.0F};
    }
    const bool textured = material.base_color_texture >= 0;
    if (textured && (!draft_->has_color || material.base_color == std::array<float, 3>{})) {
      material.base_color = {1.0F, 1.0F, 1.0F};
    }
    // illum 0 and 1 have no highlight. Ks is the coat's reflectance at normal incidence. Files with
    // the old (nearly) white default mean "shiny", not a mirror; clear coats reflect at most 8 %.
    if (draft_->specular && draft_->illumination >= 2) {
      const auto& ks = *draft_->specular;
      material.coat.f0 = std::min((ks[0] + ks[1] + ks[2]) / 3.0F, 0.08F);
    }
    // A roughness or metallic statement implies a physically based surface with glTF's coat.
    const bool physical = draft_->roughness.has_value() || material.metallic > 0.0F;
    if (!draft_->specular && physical && draft_->illumination >= 2) {
      material.coat.f0 = kDielectricF0;
    }
    if (draft_->exponent) {
      // Blinn–Phong exponent to GGX roughness: alpha² = 2/(n+2), alpha = roughness²
      // (Karis 2013, "Specular BRDF Reference").
      const float exponent = *draft_->exponent;
      material.roughness = std::pow(2.0F / (exponent + 2.0F), 0.25F);
    }
    MaterialLayers& layers = material.detail.layers;
    if (layers.clearcoat == 0.0F) layers.clearcoat_roughness = 0.0F;
    if (layers.sheen_color != std::array<float, 3>{}) layers.sheen_roughness = kClothRoughness;
    if (draft_->roughness) material.roughness = std::clamp(*draft_->roughness, 0.0F, 1.0F);
    model_->materials.push_back(std::move(material));
    draft_.reset();
    return {};
  }

  ObjLines lines_;
  const std::filesystem::path& file_;
  const ObjCompanions& companions_;
  Model* model_;
  std::optional<Draft> draft_;
  bool has_material_ = false;
  std::map<std::string, int> textures_;  ///< By name and use.
};

}  // namespace

Result<void> ParseMtl(std::string_view text, const std::filesystem::path& file,
                      const ObjCompanions& companions, Model* model) {
  return MtlParser(text, file, companions, model).Parse();
}

}  // namespace pleinair::compositor
