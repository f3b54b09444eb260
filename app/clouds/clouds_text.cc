#include "app/clouds/clouds_text.h"

#include <fmt/format.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/output/cloud_layer_toml.h"

namespace pleinair::app {
namespace {

using Json = nlohmann::ordered_json;
using Outcome = clouds::FilmLayer::Outcome;

std::string RangeText(const clouds::FittedNumber& number) {
  return fmt::format("{:.3g} ({:.3g} to {:.3g})", number.value, number.low, number.high);
}

/// What was neither stated nor can be seen from one place.
std::vector<std::string> AssumedKeys(const clouds::FilmLayerFacts& facts) {
  std::vector<std::string> keys;
  if (!facts.kind) keys.emplace_back("kind");
  if (!facts.wind_m_s) keys.emplace_back("wind_m_s");
  if (!facts.wind_from_deg) keys.emplace_back("wind_from_deg");
  keys.emplace_back("base_m");
  keys.emplace_back("thickness_m");
  return keys;
}

Json NumberJson(const clouds::FittedNumber& number) {
  return {{"value", number.value}, {"low", number.low}, {"high", number.high}};
}

Json LayerJson(const clouds::CloudLayer& layer) {
  Json json = {{"kind", clouds::NameOf(layer.kind)},
               {"cover", layer.cover},
               {"optical_depth", layer.optical_depth},
               {"base_m", layer.base_m},
               {"thickness_m", layer.thickness_m},
               {"cell_m", layer.cell_m},
               {"wind_m_s", layer.wind_m_s},
               {"wind_from_deg", layer.wind_from_deg},
               {"seed", layer.seed},
               {"east_m", layer.east_m},
               {"north_m", layer.north_m}};
  if (layer.passing.seconds.empty()) return json;
  json["passing"] = {{"east_m", layer.passing.east_m},
                     {"north_m", layer.passing.north_m},
                     {"width_m", layer.passing.width_m},
                     {"seconds", layer.passing.seconds},
                     {"shifts", layer.passing.shifts}};
  return json;
}

const char* NameOf(Outcome outcome) {
  switch (outcome) {
    case Outcome::kNoClouds:
      return "no clouds";
    case Outcome::kUniform:
      return "uniform";
    case Outcome::kPassing:
      break;
  }
  return "passing";
}

}  // namespace

std::string FilmLayerToml(const clouds::FilmLayer& fitted, const clouds::FilmLayerFacts& facts,
                          const std::string& recording) {
  if (fitted.outcome == Outcome::kNoClouds) return {};
  std::string file = recording;
  for (char& c : file) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') c = '?';
  }
  std::string text =
      fmt::format("# By pleinair clouds {}. In brackets: the range of 68 %.\n", file);
  if (fitted.outcome == Outcome::kUniform) {
    text += fmt::format("# optical_depth {}{}\n# base_m and thickness_m are assumed.\n",
                        fitted.is_opaque ? "at least " : "",
                        fitted.is_opaque ? fmt::format("{:.3g}", fitted.optical_depth.low)
                                         : RangeText(fitted.optical_depth));
    return text + CloudLayerToml(fitted.layer);
  }
  text += fmt::format("# cover {}, optical_depth {}\n# cell_m / wind_m_s {} s\n",
                      RangeText(fitted.cover), RangeText(fitted.optical_depth),
                      RangeText(fitted.cell_over_wind_s));
  text += fmt::format("# Assumed: {}.\n", fmt::join(AssumedKeys(facts), ", "));
  text += fmt::format("# Light of the film within {:.1f} % RMS, the sun within {:.1f} %.\n",
                      100.0 * fitted.errors.light, 100.0 * fitted.errors.sun);
  return text + CloudLayerToml(fitted.layer);
}

std::string FilmLayerJson(const clouds::FilmLayer& fitted, const clouds::FilmLayerFacts& facts,
                          const clouds::FilmCourse& course) {
  Json json = {{"outcome", NameOf(fitted.outcome)}};
  const bool has_layer = fitted.outcome != Outcome::kNoClouds;
  const bool passes = fitted.outcome == Outcome::kPassing;
  json["cloud_layer"] = has_layer ? LayerJson(fitted.layer) : Json();
  json["cover"] = has_layer ? NumberJson(fitted.cover) : Json();
  json["optical_depth"] = has_layer ? NumberJson(fitted.optical_depth) : Json();
  json["optical_depth_is_lower_bound"] = fitted.is_opaque;
  json["cell_over_wind_s"] = passes ? NumberJson(fitted.cell_over_wind_s) : Json();
  json["assumed"] = passes ? Json(AssumedKeys(facts)) : Json(Json::array());
  json["sun_rms"] = passes ? Json(fitted.errors.sun) : Json();
  json["sky_rms"] = passes && !course.sky.empty() ? Json(fitted.errors.sky) : Json();
  json["light_rms"] = passes ? Json(fitted.errors.light) : Json();
  json["frames"] = course.seconds.size();
  json["seconds"] = course.Span();
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string FilmCourseCsv(const clouds::FilmCourse& course, const clouds::FilmLayer& fitted) {
  std::string csv = "seconds,sun,sky,layer_sun,layer_sky\n";
  const clouds::FilmCourse& light = fitted.light;
  for (std::size_t i = 0; i < course.seconds.size(); ++i) {
    const double seconds = course.seconds[i];
    csv += fmt::format("{:.6f},{:.5f},", seconds, course.sun[i]);
    if (!course.sky.empty()) csv += fmt::format("{:.5f}", course.sky[i]);
    csv += fmt::format(",{:.5f},", clouds::ValueAt(light.seconds, light.sun, seconds));
    if (!light.sky.empty()) {
      csv += fmt::format("{:.5f}", clouds::ValueAt(light.seconds, light.sky, seconds));
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace pleinair::app
