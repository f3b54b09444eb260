#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <sstream>
#include <utility>

#include "devices/scene_facts.h"
#include "devices/sky_words.h"

namespace pleinair::devices {
namespace {

/// One table of the scene, with the names for messages.
class Table {
 public:
  Table(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  /// Refuses keys that are not among `known`.
  Result<void> AllowOnly(std::initializer_list<std::string_view> known) const {
    for (const auto& [key, value] : table_) {
      bool found = false;
      std::string list;
      for (const std::string_view name : known) {
        found = found || key.str() == name;
        list += (list.empty() ? "" : ", ") + std::string(name);
      }
      if (!found) {
        return Fail(key.source(), Quoted(key.str().substr(0, 64)) + " is unknown",
                    "known here: " + list);
      }
    }
    return {};
  }

  const toml::node* Find(const char* key) const { return table_.get(key); }

  Result<std::optional<double>> Number(const char* key) const {
    const toml::node* node = Find(key);
    if (node == nullptr) return std::nullopt;
    return Number(*node, key);
  }

  Result<std::optional<std::string>> Text(const char* key) const {
    const toml::node* node = Find(key);
    if (node == nullptr) return std::nullopt;
    const std::optional<std::string> text = node->value_exact<std::string>();
    if (!text) return Fail(node->source(), Quoted(key) + " is not a text in quotes");
    return text;
  }

  Result<std::optional<bool>> Flag(const char* key) const {
    const toml::node* node = Find(key);
    if (node == nullptr) return std::nullopt;
    const std::optional<bool> flag = node->value_exact<bool>();
    if (!flag) return Fail(node->source(), Quoted(key) + " is neither true nor false");
    return flag;
  }

  Result<std::optional<int>> Integer(const char* key) const {
    const toml::node* node = Find(key);
    if (node == nullptr) return std::nullopt;
    const std::optional<std::int64_t> number = node->value_exact<std::int64_t>();
    if (!number || *number < 0 || *number > std::numeric_limits<int>::max()) {
      return Fail(node->source(), Quoted(key) + " is not a whole number from 0 up");
    }
    return static_cast<int>(*number);
  }

  /// Three numbers.
  Result<std::optional<Vec3>> Triple(const char* key) const {
    const toml::node* node = Find(key);
    if (node == nullptr) return std::nullopt;
    const toml::array* list = node->as_array();
    if (list == nullptr || list->size() != 3) {
      return Fail(node->source(), Quoted(key) + " is not a list of three numbers");
    }
    double numbers[3] = {};
    for (std::size_t i = 0; i < 3; ++i) {
      PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> number, Number((*list)[i], key));
      numbers[i] = number.value_or(0.0);
    }
    return Vec3{numbers[0], numbers[1], numbers[2]};
  }

  /// A length in metres, said in metres or in millimetres.
  Result<std::optional<double>> Length(const char* metres, const char* millimetres) const {
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> in_m, Number(metres));
    PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> in_mm, Number(millimetres));
    if (in_m && in_mm) {
      return Fail(Find(millimetres)->source(),
                  Quoted(metres) + " and " + Quoted(millimetres) + " are both given",
                  "keep one of them");
    }
    return in_mm ? std::optional<double>(*in_mm * 1e-3) : in_m;
  }

  /// The tables under `key`, written as [key] or as [[key]].
  Result<std::vector<Table>> Tables(const char* key) const {
    std::vector<Table> tables;
    const toml::node* node = Find(key);
    if (node == nullptr) return tables;
    if (const toml::table* table = node->as_table()) {
      tables.emplace_back(*table, file_);
      return tables;
    }
    const toml::array* list = node->as_array();
    if (list == nullptr) return Fail(node->source(), Quoted(key) + " is not a table");
    for (const toml::node& item : *list) {
      const toml::table* table = item.as_table();
      if (table == nullptr) return Fail(item.source(), Quoted(key) + " is not a table");
      tables.emplace_back(*table, file_);
    }
    return tables;
  }

  tl::unexpected<Error> Fail(const toml::source_region& source, std::string what,
                             std::string remedy = {}) const {
    return InputError(file_ + ":" + std::to_string(source.begin.line), std::move(what),
                      std::move(remedy));
  }

  tl::unexpected<Error> Fail(const char* key, std::string what, std::string remedy = {}) const {
    return Fail(Find(key)->source(), Quoted(key) + " " + std::move(what), std::move(remedy));
  }

 private:
  static std::string Quoted(std::string_view key) { return "\"" + std::string(key) + "\""; }

  Result<std::optional<double>> Number(const toml::node& node, const char* key) const {
    const std::optional<double> number = node.value<double>();
    if (!number || node.is_boolean()) {
      return Fail(node.source(), Quoted(key) + " is not a number");
    }
    if (!std::isfinite(*number)) return Fail(node.source(), Quoted(key) + " is not finite");
    return number;
  }

  const toml::table& table_;
  std::string file_;
};

// A quoted RFC 3339 time or TOML's own offset date-time.
Result<std::optional<UtcTime>> ReadTime(const Table& table, const char* key) {
  const toml::node* node = table.Find(key);
  if (node == nullptr) return std::nullopt;
  std::string text;
  if (const toml::value<toml::date_time>* moment = node->as_date_time()) {
    // toml++ prints RFC 3339; without an offset the parser below refuses it.
    std::ostringstream printed;
    printed << moment->get();
    text = printed.str();
  } else if (const std::optional<std::string> quoted = node->value_exact<std::string>()) {
    text = *quoted;
  } else {
    return table.Fail(key, "is not a date and time",
                      "write it as RFC 3339, for example 2025-09-14T11:05:00Z");
  }
  Result<UtcTime> time = UtcTime::Parse(text);
  if (!time) return table.Fail(key, "is no moment: " + time.error().what, time.error().remedy);
  return *time;
}

Result<void> ReadPlace(const Table& place, SceneFacts* facts) {
  PLEINAIR_RETURN_IF_ERROR(
      place.AllowOnly({"name", "latitude_deg", "longitude_deg", "height_m", "time"}));
  PLEINAIR_RETURN_IF_ERROR(place.Text("name"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->latitude_deg, place.Number("latitude_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->longitude_deg, place.Number("longitude_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->height_m, place.Number("height_m"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<UtcTime> time, ReadTime(place, "time"));
  if (time && facts->start) {
    return place.Fail("time", "is given here and at the top", "keep one of them");
  }
  if (time) facts->start = time;
  return {};
}

Result<void> ReadMarker(const Table& marker, SceneFacts* facts) {
  PLEINAIR_RETURN_IF_ERROR(
      marker.AllowOnly({"family", "id", "size_m", "size_mm", "board_size_m", "board_size_mm",
                        "heading_deg", "upright", "albedo_black", "albedo_white"}));
  PLEINAIR_ASSIGN_OR_RETURN(facts->marker_family, marker.Text("family"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->marker_id, marker.Integer("id"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->marker_size_m, marker.Length("size_m", "size_mm"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->marker_board_size_m,
                            marker.Length("board_size_m", "board_size_mm"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->marker_heading_deg, marker.Number("heading_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->marker_upright, marker.Flag("upright"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->albedo_black, marker.Number("albedo_black"));
  PLEINAIR_ASSIGN_OR_RETURN(facts->albedo_white, marker.Number("albedo_white"));
  return {};
}

Result<ModelReference> ReadModel(const Table& table, const Table& scene, const char* key) {
  PLEINAIR_RETURN_IF_ERROR(
      table.AllowOnly({"file", "shading", "translation_m", "rotation_deg", "scale"}));
  ModelReference model;
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> file, table.Text("file"));
  if (!file || file->empty()) return scene.Fail(key, "has no file", "add file = \"name.obj\"");
  model.file = *file;
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> shading, table.Text("shading"));
  if (shading) {
    if (*shading == "flat") {
      model.shading = Shading::kFlat;
    } else if (*shading == "smooth") {
      model.shading = Shading::kSmooth;
    } else if (*shading != "file") {
      return table.Fail("shading", "is not known", "known are file, flat and smooth");
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<Vec3> translation, table.Triple("translation_m"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<Vec3> rotation, table.Triple("rotation_deg"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> scale, table.Number("scale"));
  model.translation_m = translation.value_or(Vec3{});
  model.rotation_deg = rotation.value_or(Vec3{});
  model.scale = scale.value_or(1.0);
  return model;
}

Result<std::vector<ModelReference>> ReadModels(const Table& scene, const char* key) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<Table> tables, scene.Tables(key));
  std::vector<ModelReference> models;
  for (const Table& table : tables) {
    PLEINAIR_ASSIGN_OR_RETURN(ModelReference model, ReadModel(table, scene, key));
    models.push_back(std::move(model));
  }
  return models;
}

Result<SceneFacts> ReadScene(const Table& scene) {
  PLEINAIR_RETURN_IF_ERROR(scene.AllowOnly({"time", "cloudiness", "turbidity", "exposure_gain",
                                            "place", "marker", "phantom", "object"}));
  SceneFacts facts;
  PLEINAIR_ASSIGN_OR_RETURN(facts.start, ReadTime(scene, "time"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<Table> places, scene.Tables("place"));
  if (places.size() > 1) return scene.Fail("place", "is given more than once", "keep one place");
  if (!places.empty()) PLEINAIR_RETURN_IF_ERROR(ReadPlace(places[0], &facts));
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<Table> markers, scene.Tables("marker"));
  if (markers.size() > 1) {
    return scene.Fail("marker", "is given more than once",
                      "keep the marker that the models are placed on: one anchors a scene");
  }
  if (!markers.empty()) PLEINAIR_RETURN_IF_ERROR(ReadMarker(markers[0], &facts));
  PLEINAIR_ASSIGN_OR_RETURN(facts.phantoms, ReadModels(scene, "phantom"));
  PLEINAIR_ASSIGN_OR_RETURN(facts.objects, ReadModels(scene, "object"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> sky, scene.Text("cloudiness"));
  if (sky) {
    facts.cloudiness = CloudinessFromWords(*sky);
    if (!facts.cloudiness) {
      return scene.Fail("cloudiness", "is not known", std::string("known are ") + kSkyWords);
    }
  }
  PLEINAIR_ASSIGN_OR_RETURN(facts.turbidity, scene.Number("turbidity"));
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<Vec3> gain, scene.Triple("exposure_gain"));
  if (gain) facts.exposure_gain = LinearRgb{gain->x, gain->y, gain->z};
  return facts;
}

}  // namespace

Result<SceneFacts> ParseSceneToml(std::string_view bytes, const std::string& name) {
  const toml::parse_result parsed = toml::parse(bytes);
  if (!parsed) {
    const toml::parse_error& error = parsed.error();
    return InputError(name + ":" + std::to_string(error.source().begin.line),
                      "is not TOML: " + std::string(error.description()),
                      "mend that line, or get a whole copy of the file");
  }
  return ReadScene(Table(parsed.table(), name));
}

}  // namespace pleinair::devices
