#include "app/leaf/leaf_table.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compositor/leaf/leaf_color.h"
#include "compositor/leaf/prospect.h"
#include "files/csv.h"
#include "files/result_file.h"

namespace pleinair::app {
namespace {

constexpr std::array<const char*, 3> kRefractiveKeys{"refractive_r", "refractive_g",
                                                     "refractive_b"};
constexpr const char* kLeafTableHelp =
    "start it with a line of names: name,model,structure,chlorophyll_ug_cm2,carotenoids_ug_cm2, "
    "anthocyanins_ug_cm2,brown,water_cm,dry_g_cm2,refractive_r,refractive_g,refractive_b";

Result<double> ReadLeafNumber(const files::CsvReader& record, const std::string& key,
                              const std::string& text) {
  const std::optional<double> value = files::ParseNumber(text);
  if (value) return *value;
  return InputError(record.Where(), key + " \"" + text.substr(0, 40) + "\" is not a number",
                    "give a finite number");
}

Result<void> ReadLeafField(const files::CsvReader& record, const std::string& key,
                           const std::string& text, NamedLeaf* leaf) {
  if (files::Trimmed(text).empty()) return {};
  if (key == "name") {
    leaf->name = text;
    return {};
  }
  if (key == "model") {
    PLEINAIR_ASSIGN_OR_RETURN(leaf->leaf.model,
                              ParseLeafModel(files::Trimmed(text), record.Where()));
    return {};
  }
  PLEINAIR_ASSIGN_OR_RETURN(const double value, ReadLeafNumber(record, key, text));
  for (std::size_t c = 0; c < kRefractiveKeys.size(); ++c) {
    if (key != kRefractiveKeys[c]) continue;
    leaf->leaf.refractive_index[c] = value;
    return CheckLeafRefraction(key, value, record.Where());
  }
  for (const scene::LeafQuantity& quantity : scene::kLeafQuantities) {
    if (key != quantity.key) continue;
    leaf->leaf.contents.*quantity.value = value;
    return scene::CheckLeafQuantity(quantity, value, record.Where());
  }
  return {};
}

bool IsLeafColumn(const std::string& key) {
  return key == "name" || key == "model" || std::ranges::count(kRefractiveKeys, key) != 0 ||
         std::ranges::any_of(scene::kLeafQuantities,
                             [&](const scene::LeafQuantity& q) { return key == q.key; });
}

Result<std::vector<std::string>> ReadLeafColumns(const files::CsvReader& header) {
  std::vector<std::string> columns;
  for (const std::string& field : header.fields()) {
    const std::string key(files::Trimmed(field));
    if (!IsLeafColumn(key)) {
      return InputError(header.Where(), "the column \"" + key.substr(0, 40) + "\" is unknown",
                        kLeafTableHelp);
    }
    PLEINAIR_RETURN_IF_ERROR(header.FindColumn(key));  // Refuses a second one.
    columns.push_back(key);
  }
  return columns;
}

/// A field of CSV, in quotes where it needs them.
std::string LeafCsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

compositor::LeafColors ColorsUnderD65(const scene::Leaf& leaf) {
  return compositor::ColorsOfLeaf(leaf, compositor::LeafIlluminant::D65());
}

}  // namespace

Result<scene::LeafModel> ParseLeafModel(std::string_view name, const std::string& where) {
  for (const scene::LeafModel model : {scene::LeafModel::kProspectD, scene::LeafModel::kPlate}) {
    if (name == scene::NameOf(model)) return model;
  }
  return InputError(where, "the model \"" + std::string(name.substr(0, 40)) + "\" is unknown",
                    "known are prospect-d and plate");
}

Result<void> CheckLeafRefraction(const std::string& key, double value, const std::string& where) {
  if (value >= scene::kMinLeafRefraction && value <= scene::kMaxLeafRefraction) return {};
  return InputError(where,
                    fmt::format("{} is {:g}: {:g} to {:g}", key, value, scene::kMinLeafRefraction,
                                scene::kMaxLeafRefraction),
                    "leaves have 1.3 to 1.6");
}

Result<std::vector<NamedLeaf>> ParseLeafTable(std::string_view text, const std::string& file) {
  files::CsvReader reader(text, file);
  PLEINAIR_ASSIGN_OR_RETURN(const bool has_header, reader.Next());
  if (!has_header) return InputError(file, "is empty", kLeafTableHelp);
  PLEINAIR_ASSIGN_OR_RETURN(const std::vector<std::string> columns, ReadLeafColumns(reader));
  std::vector<NamedLeaf> leaves;
  while (true) {
    PLEINAIR_ASSIGN_OR_RETURN(const bool more, reader.Next());
    if (!more) return leaves;
    PLEINAIR_RETURN_IF_ERROR(reader.CheckFieldCount(columns.size()));
    NamedLeaf leaf;
    leaf.name = std::to_string(leaves.size() + 1);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      PLEINAIR_RETURN_IF_ERROR(ReadLeafField(reader, columns[i], reader.fields()[i], &leaf));
    }
    leaves.push_back(std::move(leaf));
  }
}

Result<void> WriteLeafColors(const std::vector<NamedLeaf>& leaves, bool json) {
  PLEINAIR_ASSIGN_OR_RETURN(files::ResultFile table, files::ResultFile::Open(""));
  std::ostream& out = table.stream();
  if (!json) {
    out << "name,model,reflectance_r,reflectance_g,reflectance_b,transmittance_r,"
           "transmittance_g,transmittance_b\n";
  }
  for (const NamedLeaf& leaf : leaves) {
    if (json) {
      out << LeafJson(leaf) << '\n';
      continue;
    }
    const auto [r, t] = ColorsUnderD65(leaf.leaf);
    out << fmt::format("{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", LeafCsvField(leaf.name),
                       scene::NameOf(leaf.leaf.model), r.r, r.g, r.b, t.r, t.g, t.b);
  }
  return table.Finish();
}

Result<void> WriteLeafSpectra(const std::vector<NamedLeaf>& leaves, const std::string& file,
                              int first_nm, int last_nm) {
  for (const NamedLeaf& leaf : leaves) {
    if (leaf.leaf.model != scene::LeafModel::kPlate) continue;
    return InputError(
        "--spectra",
        "leaf \"" + leaf.name.substr(0, 40) + "\" is of the model plate, which has no spectrum",
        "use the model prospect-d");
  }
  PLEINAIR_ASSIGN_OR_RETURN(files::ResultFile output, files::ResultFile::Open(file));
  output.stream() << "name,wavelength_nm,reflectance,transmittance\n";
  std::vector<compositor::LeafOptics> optics(static_cast<std::size_t>(last_nm - first_nm + 1));
  for (const NamedLeaf& leaf : leaves) {
    compositor::ProspectSpectrum(leaf.leaf.contents, first_nm, optics);
    const std::string name = LeafCsvField(leaf.name);
    std::string lines;
    for (std::size_t i = 0; i < optics.size(); ++i) {
      fmt::format_to(std::back_inserter(lines), "{},{},{:.6f},{:.6f}\n", name,
                     first_nm + static_cast<int>(i), optics[i].reflectance,
                     optics[i].transmittance);
    }
    output.stream() << lines;
  }
  return output.Finish();
}

std::string LeafText(const scene::Leaf& leaf) {
  std::string text = fmt::format("{:<20} {}\n", "model", scene::NameOf(leaf.model));
  for (const scene::LeafQuantity& quantity : scene::kLeafQuantities) {
    text += fmt::format("{:<20} {:g}\n", quantity.key, leaf.contents.*quantity.value);
  }
  const auto [r, t] = ColorsUnderD65(leaf);
  text += fmt::format("{:<20} {:.4f} {:.4f} {:.4f}\n", "reflectance_rgb", r.r, r.g, r.b);
  text += fmt::format("{:<20} {:.4f} {:.4f} {:.4f}\n", "transmittance_rgb", t.r, t.g, t.b);
  return text + "Colors: linear Rec.709 under D65; a white diffuser has 1 1 1.\n";
}

std::string LeafJson(const NamedLeaf& leaf) {
  nlohmann::ordered_json object;
  if (!leaf.name.empty()) object["name"] = leaf.name;
  object["model"] = scene::NameOf(leaf.leaf.model);
  for (const scene::LeafQuantity& quantity : scene::kLeafQuantities) {
    object[quantity.key] = leaf.leaf.contents.*quantity.value;
  }
  if (leaf.leaf.model == scene::LeafModel::kPlate) {
    object["refractive_index"] = leaf.leaf.refractive_index;
  }
  const auto [r, t] = ColorsUnderD65(leaf.leaf);
  object["reflectance_rgb"] = {r.r, r.g, r.b};
  object["transmittance_rgb"] = {t.r, t.g, t.b};
  return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace pleinair::app
