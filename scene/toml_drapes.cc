#include "scene/toml_drapes.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

namespace pleinair::scene {
namespace {

/// Range of a number.
struct NumberKey {
  const char* key;
  double min, max;
  const char* remedy;
};
constexpr NumberKey kWidth_m{"line_width_m", 0.001, 1000.0, "give 0.001 to 1000 metres"};
constexpr NumberKey kWidth_px{"line_width_px", 0.1, 1000.0, "give 0.1 to 1000 pixels"};
constexpr NumberKey kOpacity{"opacity", 0.0, 1.0, "give 0 (invisible) to 1 (opaque)"};
constexpr NumberKey kOffset{"offset_m", -10000.0, 10000.0, "give -10000 to 10000 metres"};

Result<std::optional<double>> ReadNumber(const TomlTable& table, const NumberKey& key) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<double> number, table.Number(key.key));
  if (number && !(*number >= key.min && *number <= key.max)) {
    return table.Fail(key.key, "is out of range", key.remedy);
  }
  return number;
}

/// A text that is not empty.
Result<std::optional<std::string>> ReadText(const TomlTable& table, const char* key) {
  PLEINAIR_ASSIGN_OR_RETURN(std::optional<std::string> text, table.Text(key));
  if (text && text->empty()) return table.Fail(key, "is empty", "leave it out");
  return text;
}

Result<std::optional<LinearRgb>> ReadHexColor(const TomlTable& table, const char* key) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> text, table.Text(key));
  if (!text) return std::nullopt;
  const std::optional<LinearRgb> color = ParseHexColor(*text);
  if (!color) return table.Fail(key, "is no color", "write it as sRGB, for example \"#d02010\"");
  return color;
}

/// One of several words; the first one where the key is missing.
template <typename Word>
Result<Word> ReadWord(const TomlTable& table, const char* key, std::initializer_list<Word> words) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::optional<std::string> text, table.Text(key));
  if (!text) return *words.begin();
  std::string known;
  for (const Word word : words) {
    if (*text == NameOf(word)) return word;
    known += (known.empty() ? "known are " : ", ") + std::string(NameOf(word));
  }
  return table.Fail(key, "is not known", known);
}

Result<void> Exclude(const TomlTable& table, const char* one, const char* other) {
  if (table.Find(one) == nullptr || table.Find(other) == nullptr) return {};
  return table.Fail(other, "and \"" + std::string(one) + "\" are both given", "keep one of them");
}

Result<MapSource> ReadSource(const TomlTable& table) {
  MapSource source;
  PLEINAIR_ASSIGN_OR_RETURN(const auto file, ReadText(table, "file"));
  if (!file) return table.FailHere("has no file", "add for example file = \"plan.gpkg\"");
  source.file = *file;
  PLEINAIR_ASSIGN_OR_RETURN(const auto layer, ReadText(table, "layer"));
  source.layer = layer.value_or("");
  PLEINAIR_ASSIGN_OR_RETURN(const auto where, ReadText(table, "where"));
  source.where = where.value_or("");
  PLEINAIR_ASSIGN_OR_RETURN(const auto crs, ReadText(table, "crs"));
  source.crs = crs.value_or("");
  return source;
}

Result<InkDescription> ReadInk(const TomlTable& table) {
  InkDescription ink;
  PLEINAIR_RETURN_IF_ERROR(Exclude(table, kWidth_m.key, kWidth_px.key));
  PLEINAIR_ASSIGN_OR_RETURN(const auto width_m, ReadNumber(table, kWidth_m));
  PLEINAIR_ASSIGN_OR_RETURN(const auto width_px, ReadNumber(table, kWidth_px));
  ink.width_in_px = width_px.has_value();
  ink.line_width = width_px.value_or(width_m.value_or(ink.line_width));
  PLEINAIR_RETURN_IF_ERROR(Exclude(table, "color", "color_field"));
  PLEINAIR_ASSIGN_OR_RETURN(const auto color, ReadHexColor(table, "color"));
  ink.color = color.value_or(ink.color);
  PLEINAIR_ASSIGN_OR_RETURN(const auto color_field, ReadText(table, "color_field"));
  ink.color_field = color_field.value_or("");
  PLEINAIR_ASSIGN_OR_RETURN(ink.fill, ReadHexColor(table, "fill"));
  PLEINAIR_ASSIGN_OR_RETURN(const auto opacity, ReadNumber(table, kOpacity));
  ink.opacity = opacity.value_or(ink.opacity);
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<double> dash, table.Numbers("dash_m"));
  if (table.Find("dash_m") != nullptr) {
    const bool fits = dash.size() == 2 &&
                      std::all_of(dash.begin(), dash.end(), [](double m) { return m >= 0.001; });
    if (!fits) {
      return table.Fail("dash_m", "is no dash and gap",
                        "give their lengths, 0.001 m or more: [1.0, 0.5]");
    }
    ink.dash_m = {dash[0], dash[1]};
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      ink.blend, ReadWord(table, "blend", {InkBlend::kStain, InkBlend::kPaint, InkBlend::kGlow}));
  PLEINAIR_ASSIGN_OR_RETURN(ink.hidden,
                            ReadWord(table, "hidden", {HiddenInk::kHide, HiddenInk::kGhost}));
  return ink;
}

Result<DrapeDescription> ReadDrape(const TomlTable& table) {
  PLEINAIR_RETURN_IF_ERROR(table.AllowOnly(
      {"file", "layer", "where", "crs", "line_width_m", "line_width_px", "color", "color_field",
       "fill", "opacity", "dash_m", "blend", "on", "offset_m", "height_field", "hidden", "live"}));
  DrapeDescription drape;
  drape.where = table.WhereHere();
  PLEINAIR_ASSIGN_OR_RETURN(drape.source, ReadSource(table));
  PLEINAIR_ASSIGN_OR_RETURN(drape.ink, ReadInk(table));
  PLEINAIR_ASSIGN_OR_RETURN(const auto on, ReadText(table, "on"));
  drape.on = on.value_or(kOnTop);
  if (on) drape.where = table.WhereOf("on");
  PLEINAIR_ASSIGN_OR_RETURN(const auto offset_m, ReadNumber(table, kOffset));
  drape.offset_m = offset_m.value_or(0.0);
  PLEINAIR_ASSIGN_OR_RETURN(const auto height_field, ReadText(table, "height_field"));
  drape.height_field = height_field.value_or("");
  if (drape.height_field == kOwnHeights && on) {
    return table.Fail("on", "has no meaning with height_field = \"z\"",
                      "leave one out: lines with their own heights lie on no surface");
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      drape.search,
      ReadWord(table, "live", {DrapeSearch::kAuto, DrapeSearch::kExact, DrapeSearch::kScreen}));
  return drape;
}

}  // namespace

Result<std::vector<DrapeDescription>> ReadDrapes(const TomlTable& scene) {
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<TomlTable> tables, scene.Tables("drape"));
  if (tables.size() > kMaxDrapes) {
    return InputError(tables[kMaxDrapes].WhereHere(), "is one [[drape]] too many",
                      "keep " + std::to_string(kMaxDrapes) + " at most");
  }
  std::vector<DrapeDescription> drapes;
  drapes.reserve(tables.size());
  for (const TomlTable& table : tables) {
    PLEINAIR_ASSIGN_OR_RETURN(DrapeDescription drape, ReadDrape(table));
    drapes.push_back(std::move(drape));
  }
  return drapes;
}

}  // namespace pleinair::scene
