#include "app/model/model_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "app/output/length_text.h"
#include "scene/length_units.h"

namespace pleinair::app {
namespace {

using compositor::Material;
using compositor::Model;
using compositor::ModelFrame;

// Diagonal of a model beyond which its unit is doubtful, metres.
constexpr double kDoubtfullyLarge_m = 100.0, kDoubtfullySmall_m = 0.02;
// Materials and textures that the text lists; JSON lists all.
constexpr std::size_t kMaxListed = 20;

std::string_view FormatName(Model::Format format) {
  return format == Model::Format::kGltf ? "glTF 2.0" : "OBJ";
}

/// The axes as understood: "y up", …
std::string UpText(const Model& model, const ModelFrame& frame) {
  if (frame.file_up) return *frame.file_up == UpAxis::kY ? "y is up" : "z is up";
  if (model.format == Model::Format::kGltf) return "y is up, as glTF defines";
  return "those of the marker; z is up on the ground";
}

std::string_view UnitName(const ModelFrame& frame) { return scene::NameOfUnit(frame.unit_m); }

/// How a material is seen through: "opaque", "holes" or "glass".
std::string_view AlphaName(const Model& model, const Material& material) {
  const int texture = material.base_color_texture;
  const bool varies =
      texture >= 0 && model.textures[static_cast<std::size_t>(texture)].channels() == 4;
  if (material.alpha == Material::Alpha::kIgnored || (material.opacity >= 1.0F && !varies)) {
    return "opaque";
  }
  return material.alpha == Material::Alpha::kCutout ? "holes" : "glass";
}

/// The textures of a material by their use.
std::vector<std::pair<const char*, int>> TexturesOf(const Material& material) {
  std::vector<std::pair<const char*, int>> textures{
      {"color", material.base_color_texture},
      {"roughness and metal", material.metallic_roughness_texture},
      {"normals", material.detail.normal_map.texture},
      {"emission", material.detail.emission.texture},
      {"diffuse transmission", material.detail.transmission.texture}};
  std::erase_if(textures, [](const auto& texture) { return texture.second < 0; });
  return textures;
}

/// Materials that meshes use, by index.
std::set<int> UsedMaterials(const Model& model) {
  std::set<int> used;
  for (const compositor::Mesh& mesh : model.meshes) used.insert(mesh.material);
  return used;
}

void AddUnitNote(double size_m, std::vector<std::string>* notes) {
  if (size_m > kDoubtfullyLarge_m) {
    notes->push_back(
        fmt::format("it is {} large; in millimetres it would be {}: unit = \"mm\" (--unit mm)",
                    LengthText(size_m), LengthText(size_m * 1e-3)));
  } else if (size_m < kDoubtfullySmall_m) {
    notes->push_back(fmt::format("it is {} large; scale = 1000 makes it {}", LengthText(size_m),
                                 LengthText(size_m * 1e3)));
  }
}

nlohmann::json Triple(Vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace

ModelFacts FactsOf(const Model& model, const ModelFrame& frame, bool unit_stated) {
  ModelFacts facts;
  for (const compositor::Mesh& mesh : model.meshes) {
    // A surface with holes has a second mesh, which only casts shadows.
    if (mesh.role == compositor::MeshRole::kShadowOnly) continue;
    ++facts.meshes;
    facts.vertices += mesh.positions.size();
    facts.triangles += mesh.indices.size() / 3;
  }
  facts.bounds = BoundsOf(model);
  const double size_m = Norm(facts.bounds.Size());
  if (!unit_stated) AddUnitNote(size_m, &facts.notes);
  if (!frame.file_up && LooksYUp(model)) {
    facts.notes.emplace_back("it is probably modelled with y up: up = \"y\" (--up y)");
  }
  if (Norm(model.origin_m) > 0.0 && Norm(facts.bounds.Centre()) > size_m) {
    facts.notes.push_back(
        fmt::format("its coordinates are far from their origin ({}), as of a survey: origin = "
                    "\"bottom centre\"",
                    LengthText(Norm(facts.bounds.Centre()))));
  }
  return facts;
}

std::string ModelText(const Model& model, const ModelFrame& frame, const ModelFacts& facts) {
  const auto& [low, high] = facts.bounds;
  const Vec3 size = facts.bounds.Size();
  std::string text = fmt::format("{}: {}{}\n", model.file.string(), FormatName(model.format),
                                 model.written_by.empty() ? "" : ", " + model.written_by);
  text += fmt::format("  size       {} x {} x {} (right, back, up)\n", LengthText(size.x),
                      LengthText(size.y), LengthText(size.z));
  text += fmt::format("  box        [{:.6g}, {:.6g}, {:.6g}] to [{:.6g}, {:.6g}, {:.6g}] m\n",
                      low.x, low.y, low.z, high.x, high.y, high.z);
  text += fmt::format("  unit       {}\n  axes       {}\n", UnitName(frame), UpText(model, frame));
  text += fmt::format("  triangles  {}, of {} vertices in {} meshes\n", facts.triangles,
                      facts.vertices, facts.meshes);
  const std::set<int> used = UsedMaterials(model);
  text += fmt::format("  materials  {}\n", used.size());
  std::size_t listed = 0;
  for (const int index : used) {
    if (++listed > kMaxListed) {
      text += fmt::format("    and {} more\n", used.size() - kMaxListed);
      break;
    }
    const Material& material = model.materials[static_cast<std::size_t>(index)];
    const auto& [r, g, b] = material.base_color;
    text += fmt::format("    {}: color {:.3f} {:.3f} {:.3f}, roughness {:.2f}, metal {:.2f}, {}\n",
                        material.name.empty() ? "(no name)" : material.name, r, g, b,
                        material.roughness, material.metallic, AlphaName(model, material));
    for (const auto& [use, texture] : TexturesOf(material)) {
      const auto& image = model.textures[static_cast<std::size_t>(texture)];
      text += fmt::format("      {}: picture of {} x {}\n", use, image.width(), image.height());
    }
  }
  if (!model.animations.empty()) {
    text += fmt::format("  animations {}\n", model.animations.size());
  }
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    if (i == kMaxListed) {
      text += fmt::format("    and {} more\n", model.animations.size() - kMaxListed);
      break;
    }
    const compositor::AnimationInFile& animation = model.animations[i];
    text +=
        fmt::format("    {}: {}, {:.2f} s\n", i,
                    animation.name.empty() ? "(no name)" : animation.name, animation.duration_s);
  }
  const std::set<std::string> unsupported = UnsupportedFeatures(model);
  text += fmt::format("  not drawn  {}\n", unsupported.empty()
                                               ? "nothing"
                                               : fmt::format("{}", fmt::join(unsupported, ", ")));
  for (const std::string& note : facts.notes) text += "  note       " + note + "\n";
  return text;
}

std::string ModelJson(const Model& model, const ModelFrame& frame, const ModelFacts& facts,
                      const std::filesystem::path& sheet) {
  nlohmann::json json = {
      {"file", model.file.string()},
      {"format", FormatName(model.format)},
      {"written_by", model.written_by},
      {"unit", UnitName(frame)},
      {"axes", UpText(model, frame)},
      {"box_m", {{"min", Triple(facts.bounds.min_m)}, {"max", Triple(facts.bounds.max_m)}}},
      {"size_m", Triple(facts.bounds.Size())},
      {"meshes", facts.meshes},
      {"vertices", facts.vertices},
      {"triangles", facts.triangles},
      {"not_drawn", UnsupportedFeatures(model)},
      {"notes", facts.notes}};
  json["materials"] = nlohmann::json::array();
  for (const int index : UsedMaterials(model)) {
    const Material& material = model.materials[static_cast<std::size_t>(index)];
    nlohmann::json entry = {
        {"name", material.name},           {"base_color", material.base_color},
        {"opacity", material.opacity},     {"alpha", AlphaName(model, material)},
        {"roughness", material.roughness}, {"metallic", material.metallic}};
    entry["textures"] = nlohmann::json::array();
    for (const auto& [use, texture] : TexturesOf(material)) {
      entry["textures"].push_back({{"use", use}, {"texture", texture}});
    }
    json["materials"].push_back(std::move(entry));
  }
  json["animations"] = nlohmann::json::array();
  for (const compositor::AnimationInFile& animation : model.animations) {
    json["animations"].push_back({{"name", animation.name}, {"duration_s", animation.duration_s}});
  }
  json["textures"] = nlohmann::json::array();
  for (const auto& image : model.textures) {
    json["textures"].push_back({{"width_px", image.width()},
                                {"height_px", image.height()},
                                {"channels", image.channels()}});
  }
  if (!sheet.empty()) json["sheet"] = sheet.string();
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace pleinair::app
