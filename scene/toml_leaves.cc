#include "scene/toml_leaves.h"

#include <array>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

namespace pleinair::scene {
namespace {

constexpr double kMinRoughness = 0.05, kMaxRoughness = 1.0, kMaxGloss = 4.0;

/// Contents under the keys of kLeafQuantities, and spad. Keys that are not given stay.
Result<void> ReadContents(const TomlTable& table, LeafContents* contents) {
  for (const LeafQuantity& quantity : kLeafQuantities) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> value, table.Number(quantity.key));
    if (!value) continue;
    PLEINAIR_RETURN_IF_ERROR(CheckLeafQuantity(quantity, *value, table.WhereOf(quantity.key)));
    contents->*quantity.value = *value;
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> spad, table.Number("spad"));
  if (!spad) return {};
  if (table.Find("chlorophyll_ug_cm2") != nullptr) {
    return table.Fail("spad", "is given beside chlorophyll_ug_cm2", "keep one of them");
  }
  PLEINAIR_ASSIGN_OR_RETURN(contents->chlorophyll_ug_cm2,
                            ChlorophyllOfSpad(*spad, table.WhereOf("spad")));
  return {};
}

/// A number between two bounds; `otherwise` where it is not given.
Result<double> ReadBetween(const TomlTable& table, const char* key, double low, double high,
                           double otherwise) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> value, table.Number(key));
  if (!value) return otherwise;
  if (*value >= low && *value <= high) return *value;
  std::array<char, 64> range{};
  std::snprintf(range.data(), range.size(), "is %g: %g to %g", *value, low, high);
  return table.Fail(key, range.data());
}

Result<UtcTime> ReadDate(const TomlTable& stage) {
  const toml::node* node = stage.Find("date");
  if (node == nullptr) return stage.FailHere("has no date", "add date = 2025-09-01");
  std::array<char, 32> text{};
  if (const toml::value<toml::date>* date = node->as_date()) {
    std::snprintf(text.data(), text.size(), "%04d-%02d-%02dT00:00:00Z", date->get().year,
                  date->get().month, date->get().day);
    if (const Result<UtcTime> time = UtcTime::Parse(text.data())) return *time;
  }
  return stage.Fail("date", "is not a date", "write it as year, month, day: 2025-09-01");
}

Result<void> ReadStages(const TomlTable& table, LeafDescription* leaf) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> stages, table.Tables("stage"));
  for (const TomlTable& stage : stages) {
    PLEINAIR_RETURN_IF_ERROR(
        stage.AllowOnly({"date", "chlorophyll_ug_cm2", "spad", "carotenoids_ug_cm2",
                         "anthocyanins_ug_cm2", "brown", "water_cm", "dry_g_cm2", "structure"}));
    LeafStage read{{}, leaf->leaf.contents};
    PLEINAIR_ASSIGN_OR_RETURN(read.date, ReadDate(stage));
    if (!leaf->stages.empty() && read.date <= leaf->stages.back().date) {
      return stage.Fail("date", "is not after that of the stage before",
                        "put the stages in the order of their dates");
    }
    PLEINAIR_RETURN_IF_ERROR(ReadContents(stage, &read.contents));
    leaf->stages.push_back(read);
  }
  return {};
}

Result<void> ReadMaps(const TomlTable& table, LeafMapFiles* maps) {
  const std::array<std::pair<const char*, std::filesystem::path*>, 4> files = {
      {{"structure_map", &maps->structure},
       {"pigment_map", &maps->pigment},
       {"gloss_map", &maps->gloss},
       {"thickness_map", &maps->thickness}}};
  const std::filesystem::path folder = std::filesystem::path(table.file()).parent_path();
  for (const auto& [key, file] : files) {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> name, table.Text(key));
    if (!name) continue;
    if (name->empty()) return table.Fail(key, "names no file");
    *file = (folder / *name).lexically_normal();
  }
  return {};
}

Result<LeafDescription> ReadLeaf(const TomlTable& table) {
  PLEINAIR_RETURN_IF_ERROR(table.AllowOnly(
      {"materials", "model", "chlorophyll_ug_cm2", "spad", "carotenoids_ug_cm2",
       "anthocyanins_ug_cm2", "brown", "water_cm", "dry_g_cm2", "structure", "roughness", "gloss",
       "structure_map", "pigment_map", "gloss_map", "thickness_map", "stage"}));
  LeafDescription leaf;
  leaf.where = table.WhereHere();
  PLEINAIR_ASSIGN_OR_RETURN(leaf.materials, table.Texts("materials"));
  if (leaf.materials.empty()) {
    return table.FailHere("names no materials", "add materials = [\"blade\", \"leaf_*\"]");
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> model, table.Text("model"));
  if (model && *model != kProspectDName && *model != kPlateName) {
    return table.Fail("model", "is not known", "known are prospect-d and plate");
  }
  if (model == kPlateName) leaf.leaf.model = LeafModel::kPlate;
  PLEINAIR_RETURN_IF_ERROR(ReadContents(table, &leaf.leaf.contents));
  PLEINAIR_ASSIGN_OR_RETURN(leaf.roughness,
                            ReadBetween(table, "roughness", kMinRoughness, kMaxRoughness, 0.35));
  PLEINAIR_ASSIGN_OR_RETURN(leaf.gloss, ReadBetween(table, "gloss", 0.0, kMaxGloss, 1.0));
  PLEINAIR_RETURN_IF_ERROR(ReadMaps(table, &leaf.maps));
  PLEINAIR_RETURN_IF_ERROR(ReadStages(table, &leaf));
  return leaf;
}

}  // namespace

Result<std::vector<LeafDescription>> ReadLeaves(const TomlTable& scene) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> tables, scene.Tables("leaf"));
  std::vector<LeafDescription> leaves;
  for (const TomlTable& table : tables) {
    PLEINAIR_ASSIGN_OR_RETURN(LeafDescription leaf, ReadLeaf(table));
    leaves.push_back(std::move(leaf));
  }
  return leaves;
}

}  // namespace pleinair::scene
