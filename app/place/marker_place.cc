#include "app/place/marker_place.h"

#include <cmath>
#include <cstddef>
#include <string_view>

#include "files/csv.h"
#include "scene/marker_heading.h"
#include "scene/scene_description.h"

namespace pleinair::app {
namespace {

/// Parses "LAT,LON[,HEIGHT]".
Result<content::Place> ParsePlace(const std::string& text) {
  struct Field {
    const char* name;
    double lowest, highest;
  };
  constexpr Field kFields[3] = {
      {"latitude", -90.0, 90.0}, {"longitude", -180.0, 360.0}, {"height", -11'000.0, 100'000.0}};
  double values[3] = {0.0, 0.0, 0.0};
  std::string_view rest = text;
  std::size_t count = 0;
  for (bool more = true; more && count < 3; ++count) {
    const std::size_t comma = rest.find(',');
    const auto value = files::ParseNumber(files::Trimmed(rest.substr(0, comma)));
    const Field& field = kFields[count];
    if (!value || *value < field.lowest || *value > field.highest) {
      return InputError("--at",
                        "\"" + text.substr(0, 60) + "\" has no " + field.name + " from " +
                            CLI::detail::to_string(field.lowest) + " to " +
                            CLI::detail::to_string(field.highest),
                        "write latitude, longitude and height, for example 50.0875,14.4213,220");
    }
    values[count] = *value;
    more = comma != std::string_view::npos;
    rest = more ? rest.substr(comma + 1) : std::string_view();
  }
  if (count < 2 || !rest.empty()) {
    return InputError("--at", "\"" + text.substr(0, 60) + "\" is not a place",
                      "write latitude, longitude and height, for example 50.0875,14.4213,220");
  }
  content::Place place;
  place.latitude_deg = values[0];
  place.longitude_deg = std::remainder(values[1], 360.0);
  place.height_m = values[2];
  return place;
}

}  // namespace

void AddMarkerPlaceOptions(CLI::App& command, MarkerPlaceArguments* arguments) {
  command
      .add_option("--at", arguments->at,
                  "Place of the marker: degrees, metres above sea level (default height: 0)")
      ->type_name("LAT,LON[,HEIGHT]");
  command
      .add_option("--scene", arguments->scene,
                  "Scene with place and heading: also marker coordinates")
      ->type_name("F");
  command
      .add_option("--height-reference", arguments->height_reference,
                  "What the height of the place is measured from")
      ->check(CLI::IsMember({"sea", "ellipsoid"}))
      ->default_str("sea");
}

Result<MarkerPlace> ReadMarkerPlace(const MarkerPlaceArguments& arguments,
                                    const std::string& command) {
  MarkerPlace marker;
  if (arguments.at.empty() && arguments.scene.empty()) {
    return InputError(
        "", "pleinair " + command + " needs the place of the marker",
        "give --at LAT,LON,HEIGHT or --scene FILE; see pleinair " + command + " --help");
  }
  if (!arguments.scene.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(const scene::SceneDescription scene,
                              scene::ReadSceneDescription(arguments.scene));
    marker.place.latitude_deg = scene.place_time.latitude_deg;
    marker.place.longitude_deg = scene.place_time.longitude_deg;
    marker.place.height_m = scene.place_time.height_m;
    marker.marker_from_world = scene::MarkerFromWorld(scene.marker);
  }
  if (!arguments.at.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(marker.place, ParsePlace(arguments.at));
  }
  if (arguments.height_reference == "ellipsoid") {
    marker.place.reference = content::HeightReference::kEllipsoid;
  }
  return marker;
}

}  // namespace pleinair::app
