#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "content/draping/drape_lines.h"
#include "content/georeference/local_frame.h"
#include "content/georeference/vector_layer.h"
#include "scene/scene_description.h"

namespace pleinair::app {

/// The lines of a map around the marker, before they are draped.
struct MapLines {
  std::vector<content::LineToDrape> lines;
  content::DrapeOptions options;
  std::string crs;  ///< For people: name and code, or "marker".
  /// From which geodetic places are computed back; its heights have the reference of the map.
  content::LocalFrame frame{content::GeodeticPoint{}};
  std::size_t features = 0;  ///< Those read, also without geometry.
  /// For each feature the color of its `color_field`; empty: the drape names none.
  std::vector<std::optional<LinearRgb>> colors;
  std::vector<std::string> warnings;  ///< One sentence each.
};

/// The features of a drape, as its file has them. Errors (input): those of
/// content::ReadVectorLayers().
Result<std::vector<content::VectorLayer>> ReadMap(const scene::DrapeDescription& drape);

/// Places the features around the marker of the scene, each on the plumb line of its place.
/// Features are numbered from `first_feature` on. Errors (input): those of content::PlaceLayers();
/// no coordinate reference system; a value that is no height or color, with the feature's number.
Result<MapLines> PlaceMap(const scene::SceneDescription& scene,
                          const scene::DrapeDescription& drape,
                          std::vector<content::VectorLayer> layers,
                          const content::SurfaceIndex& surface, std::uint32_t first_feature);

}  // namespace pleinair::app
