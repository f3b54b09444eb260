#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "app/leaf/leaf_table.h"
#include "app/leaf/spectrum_fit.h"
#include "app/output/light_csv_file.h"
#include "app/sky/shadow_points.h"
#include "app/sky/sky_directions.h"
#include "app/sun/sun_table.h"
#include "scene/leaf_contents.h"

// Any bytes give a table of finite values or an error, never a crash. Rows refer to the text.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto within = [&](std::string_view part) {
    return part.data() >= text.data() && part.data() + part.size() <= text.data() + text.size();
  };
  if (const auto table = pleinair::app::ParseSunTable(text, "table", {})) {
    for (const auto& row : table->rows) {
      if (!within(row.text)) std::abort();
      if (!(std::fabs(ToDegrees(row.observer.latitude)) <= 90.0)) std::abort();
      if (!std::isfinite(row.observer.pressure_mbar)) std::abort();
    }
  } else if (table.error().what.empty()) {
    std::abort();
  }
  if (const auto table = pleinair::app::ParseSkyDirections(text, "table")) {
    for (const auto& row : table->rows) {
      if (!within(row.text)) std::abort();
      if (!(std::fabs(row.azimuth_deg) <= 360.0 && std::fabs(row.elevation_deg) <= 90.0)) {
        std::abort();
      }
    }
  } else if (table.error().what.empty()) {
    std::abort();
  }
  if (const auto table = pleinair::app::ParseShadowPoints(text, "table", 0.0)) {
    for (const auto& row : table->rows) {
      if (!within(row.text)) std::abort();
      if (!(std::fabs(row.place_m.x) <= 1e6 && std::fabs(row.seconds) <= 1e7)) std::abort();
    }
  } else if (table.error().what.empty()) {
    std::abort();
  }
  if (const auto rows = pleinair::app::ParseLightCsv(text, "table")) {
    for (const auto& row : *rows) {
      if (!(row.sun.r >= 0.0 && row.sky.b >= 0.0 && row.sun_to_sky_error >= 0.0)) std::abort();
    }
  } else if (rows.error().what.empty() || rows.error().remedy.empty()) {
    std::abort();
  }
  // The text of a layer of clouds, from the command line.
  if (const auto layer = pleinair::clouds::ParseCloudLayer(text)) {
    if (!(layer->cover >= 0.0 && layer->cover <= 1.0)) std::abort();
  } else if (layer.error().what.empty() || layer.error().remedy.empty()) {
    std::abort();
  }
  if (const auto leaves = pleinair::app::ParseLeafTable(text, "table")) {
    for (const auto& [name, leaf] : *leaves) {
      for (const auto& quantity : pleinair::scene::kLeafQuantities) {
        const double value = leaf.contents.*quantity.value;
        if (!(value >= quantity.low && value <= quantity.high)) std::abort();
      }
    }
  } else if (leaves.error().what.empty()) {
    std::abort();
  }
  if (const auto spectrum = pleinair::app::ParseMeasuredSpectrum(text, "table")) {
    for (const auto* values : {&spectrum->reflectance, &spectrum->transmittance}) {
      if (!values->empty() && values->size() != spectrum->wavelength_nm.size()) std::abort();
    }
  } else if (spectrum.error().what.empty()) {
    std::abort();
  }
  return 0;
}
