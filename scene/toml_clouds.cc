#include "scene/toml_clouds.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace pleinair::scene {
namespace {

constexpr const char* kCloudTable = "cloud_layer";
constexpr const char* kPassing = "passing";

/// The error of a description at its place in the file.
template <typename T>
Result<T> LocatedAt(const std::string& where, Result<T> result) {
  if (result || !result.error().where.empty()) return result;
  Error error = std::move(result).error();
  error.where = where;
  return tl::make_unexpected(std::move(error));
}

/// The table [cloud_layer.passing].
Result<clouds::CloudPassing> ReadPassing(const TomlTable& layer, double usual_width_m) {
  clouds::CloudPassing passing;
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> tables, layer.Tables(kPassing));
  if (tables.empty()) return passing;
  if (tables.size() > 1) return tables[1].FailHere("is one [cloud_layer.passing] too many");
  const TomlTable& table = tables.front();
  PLEINAIR_RETURN_IF_ERROR(table.AllowOnly({"east_m", "north_m", "width_m", "seconds", "shifts"}));
  const auto number = [&](const char* key, double usual) -> Result<double> {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> given, table.Number(key));
    return given.value_or(usual);
  };
  PLEINAIR_ASSIGN_OR_RETURN(passing.east_m, number("east_m", 0.0));
  PLEINAIR_ASSIGN_OR_RETURN(passing.north_m, number("north_m", 0.0));
  PLEINAIR_ASSIGN_OR_RETURN(passing.width_m, number("width_m", usual_width_m));
  PLEINAIR_ASSIGN_OR_RETURN(passing.seconds, table.Numbers("seconds"));
  PLEINAIR_ASSIGN_OR_RETURN(passing.shifts, table.Numbers("shifts"));
  if (passing.seconds.empty()) return table.FailHere("has no seconds", "add seconds and shifts");
  PLEINAIR_RETURN_IF_ERROR(LocatedAt(table.WhereHere(), clouds::CheckPassing(passing)));
  return passing;
}

Result<clouds::CloudLayer> ReadCloudLayer(const TomlTable& table) {
  PLEINAIR_RETURN_IF_ERROR(
      table.AllowOnly({"kind", "cover", "optical_depth", "base_m", "thickness_m", "cell_m",
                       "wind_m_s", "wind_from_deg", "seed", "east_m", "north_m", kPassing}));
  clouds::CloudLayerFacts facts;
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> kind, table.Text("kind"));
  if (!kind) return table.FailHere("has no kind", "add for example kind = \"cumulus\"");
  PLEINAIR_ASSIGN_OR_RETURN(facts.kind,
                            LocatedAt(table.WhereOf("kind"), clouds::ParseCloudKind(*kind)));
  for (const clouds::CloudNumber& number : clouds::kCloudNumbers) {
    PLEINAIR_ASSIGN_OR_RETURN(facts.*number.fact, table.Number(number.key));
    if (!(facts.*number.fact)) continue;
    PLEINAIR_RETURN_IF_ERROR(LocatedAt(table.WhereOf(number.key),
                                       clouds::CheckCloudNumber(number, *(facts.*number.fact))));
  }
  if (const toml::node* seed = table.Find("seed")) {
    facts.seed = seed->value_exact<std::int64_t>();
    if (!facts.seed) return table.Fail("seed", "is not a whole number", "write it like 7");
  }
  PLEINAIR_ASSIGN_OR_RETURN(facts.passing, ReadPassing(table, clouds::CloudPassing{}.width_m));
  return LocatedAt(table.WhereHere(), clouds::MakeCloudLayer(facts));
}

}  // namespace

Result<std::vector<clouds::CloudLayer>> ReadCloudLayers(const TomlTable& scene) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> tables, scene.Tables(kCloudTable));
  if (tables.size() > clouds::kMaxCloudLayers) {
    return InputError(tables[clouds::kMaxCloudLayers].WhereHere(),
                      "is one [[cloud_layer]] too many",
                      "keep " + std::to_string(clouds::kMaxCloudLayers) + " at most");
  }
  std::vector<clouds::CloudLayer> layers;
  layers.reserve(tables.size());
  for (const TomlTable& table : tables) {
    PLEINAIR_ASSIGN_OR_RETURN(const clouds::CloudLayer layer, ReadCloudLayer(table));
    layers.push_back(layer);
  }
  return layers;
}

}  // namespace pleinair::scene
