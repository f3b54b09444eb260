#include "app/place/marker_place.h"

#include "app/options/place_option.h"
#include "devices/films/film_tags.h"
#include "scene/marker_heading.h"
#include "scene/scene_description.h"

namespace pleinair::app {

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
      ->default_str("that of the scene, else sea");
}

content::Place PlaceOfMarker(const scene::SceneDescription& scene) {
  const scene::PlaceTime& stated = scene.place_time;
  const content::LocalFrame around({stated.longitude_deg, stated.latitude_deg, stated.height_m});
  const content::GeodeticPoint origin = around.Geodetic({scene.marker.offset_m});
  return {origin.latitude_deg, origin.longitude_deg, origin.height_m,
          stated.above_ellipsoid ? content::HeightReference::kEllipsoid
                                 : content::HeightReference::kSeaLevel};
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
    marker.place = PlaceOfMarker(scene);
    marker.marker_from_world = scene::MarkerFromWorld(scene.marker);
  }
  if (!arguments.at.empty()) {
    PLEINAIR_ASSIGN_OR_RETURN(const devices::FilmTags::Place place, ParsePlace(arguments.at));
    marker.place.latitude_deg = place.latitude_deg;
    marker.place.longitude_deg = place.longitude_deg;
    marker.place.height_m = place.height_m.value_or(0.0);
    marker.place.reference = content::HeightReference::kSeaLevel;
  }
  if (!arguments.height_reference.empty()) {
    marker.place.reference = arguments.height_reference == "ellipsoid"
                                 ? content::HeightReference::kEllipsoid
                                 : content::HeightReference::kSeaLevel;
  }
  return marker;
}

}  // namespace pleinair::app
