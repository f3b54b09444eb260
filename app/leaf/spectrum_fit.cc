#include "app/leaf/spectrum_fit.h"

#include <array>
#include <cstddef>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compositor/leaf/prospect.h"
#include "files/csv.h"

namespace pleinair::app {
namespace {

constexpr const char* kSpectrumHelp =
    "start it with the line wavelength_nm,reflectance,transmittance; one of the last two may be "
    "missing";

struct SpectrumColumn {
  const char* name;
  double low, high;
  const char* remedy;
};
// Noise may pass the ends of 0…1.
constexpr std::array<SpectrumColumn, 3> kSpectrumColumns = {{
    {"wavelength_nm", 200.0, 20'000.0, "give nanometres; micrometres times 1,000"},
    {"reflectance", -0.1, 1.1, "give a share from 0 to 1; percent divided by 100"},
    {"transmittance", -0.1, 1.1, "give a share from 0 to 1; percent divided by 100"},
}};

/// Columns of the table, in the order of kSpectrumColumns.
using SpectrumPlaces = std::array<std::optional<std::size_t>, kSpectrumColumns.size()>;

Result<SpectrumPlaces> ReadSpectrumHeader(const files::CsvReader& header) {
  SpectrumPlaces places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    PLEINAIR_ASSIGN_OR_RETURN(places[i], header.FindColumn(kSpectrumColumns[i].name));
  }
  for (std::size_t column = 0; column < header.fields().size(); ++column) {
    bool known = false;
    for (const auto& place : places) known = known || place == column;
    if (known) continue;
    return InputError(header.Where(),
                      "the column \"" + header.fields()[column].substr(0, 40) + "\" is unknown",
                      kSpectrumHelp);
  }
  if (!places[0] || (!places[1] && !places[2])) {
    return InputError(
        header.Where(),
        std::string("the column ") + kSpectrumColumns[places[0] ? 1 : 0].name + " is missing",
        kSpectrumHelp);
  }
  return places;
}

Result<double> ReadSpectrumValue(const files::CsvReader& record, std::size_t place,
                                 const SpectrumColumn& column) {
  const std::string& text = record.fields()[place];
  const std::optional<double> value = files::ParseNumber(text);
  if (value && *value >= column.low && *value <= column.high) return *value;
  return InputError(record.Where(),
                    std::string(column.name) + " \"" + text.substr(0, 40) + "\" is not possible",
                    column.remedy);
}

}  // namespace

Result<compositor::MeasuredSpectrum> ParseMeasuredSpectrum(std::string_view text,
                                                           const std::string& file) {
  files::CsvReader reader(text, file);
  PLEINAIR_ASSIGN_OR_RETURN(const bool has_header, reader.Next());
  if (!has_header) return InputError(file, "is empty", kSpectrumHelp);
  PLEINAIR_ASSIGN_OR_RETURN(const SpectrumPlaces places, ReadSpectrumHeader(reader));
  const std::size_t columns = reader.fields().size();
  compositor::MeasuredSpectrum spectrum;
  while (true) {
    PLEINAIR_ASSIGN_OR_RETURN(const bool more, reader.Next());
    if (!more) return spectrum;
    PLEINAIR_RETURN_IF_ERROR(reader.CheckFieldCount(columns));
    std::array<double, kSpectrumColumns.size()> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!places[i]) continue;
      PLEINAIR_ASSIGN_OR_RETURN(values[i],
                                ReadSpectrumValue(reader, *places[i], kSpectrumColumns[i]));
    }
    if (values[0] < compositor::kFirstLeafNm || values[0] > compositor::kLastLeafNm) continue;
    spectrum.wavelength_nm.push_back(values[0]);
    if (places[1]) spectrum.reflectance.push_back(values[1]);
    if (places[2]) spectrum.transmittance.push_back(values[2]);
  }
}

std::string LeafFitText(const compositor::LeafFit& fit) {
  std::string text;
  for (std::size_t i = 0; i < scene::kLeafQuantities.size(); ++i) {
    const scene::LeafQuantity& quantity = scene::kLeafQuantities[i];
    text += fit.deviations[i]
                ? fmt::format("{:<20} {:.4g} ± {:.2g}{}\n", quantity.key,
                              fit.contents.*quantity.value, *fit.deviations[i], quantity.unit)
                : fmt::format("{:<20} not determined by these wavelengths\n", quantity.key);
  }
  return text + fmt::format("{:<20} {:.5f}\n", "rms", fit.rms);
}

std::string LeafFitJson(const compositor::LeafFit& fit) {
  nlohmann::ordered_json object, deviations;
  for (std::size_t i = 0; i < scene::kLeafQuantities.size(); ++i) {
    const scene::LeafQuantity& quantity = scene::kLeafQuantities[i];
    object[quantity.key] = nullptr;
    deviations[quantity.key] = nullptr;
    if (!fit.deviations[i]) continue;
    object[quantity.key] = fit.contents.*quantity.value;
    deviations[quantity.key] = *fit.deviations[i];
  }
  object["standard_deviation"] = std::move(deviations);
  object["rms"] = fit.rms;
  return object.dump();
}

}  // namespace pleinair::app
