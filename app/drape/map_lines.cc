#include "app/drape/map_lines.h"

#include <cmath>
#include <utility>

#include "app/drape/phantom_surface.h"
#include "app/place/marker_place.h"
#include "app/place/transform_warnings.h"
#include "base/parallel_for.h"
#include "content/draping/plumb_lines.h"
#include "content/georeference/placed_features.h"
#include "files/csv.h"
#include "scene/marker_heading.h"

namespace pleinair::app {
namespace {

using content::LineToDrape;
using content::MapFeature;
using content::VectorLayer;

bool HasOwnHeights(const scene::DrapeDescription& drape) {
  return drape.height_field == scene::kOwnHeights;
}

bool HasHeightField(const scene::DrapeDescription& drape) {
  return !drape.height_field.empty() && !HasOwnHeights(drape);
}

tl::unexpected<Error> BadValue(const scene::DrapeDescription& drape, const MapFeature& feature,
                               const std::string& field, const std::string& value,
                               const std::string& kind, const std::string& remedy) {
  return InputError(drape.source.file.string(),
                    "feature " + std::to_string(feature.number) + " has \"" + value.substr(0, 60) +
                        "\" in its field \"" + field + "\", which is no " + kind,
                    remedy);
}

/// Height above the surface of a feature, by its attribute. Without a value it is 0.
Result<double> HeightOf(const scene::DrapeDescription& drape, const MapFeature& feature) {
  if (!HasHeightField(drape) || !feature.values.front()) return 0.0;
  const std::string& text = *feature.values.front();
  const std::optional<double> metres = files::ParseNumber(files::Trimmed(text));
  if (metres && std::fabs(*metres) <= 1e5) return *metres;
  return BadValue(drape, feature, drape.height_field, text, "height in metres",
                  "correct it, or leave height_field out");
}

/// Color of a feature, by its attribute.
Result<std::optional<LinearRgb>> ColorOf(const scene::DrapeDescription& drape,
                                         const MapFeature& feature) {
  if (!feature.values.back() || feature.values.back()->empty()) return std::nullopt;
  const std::string& text = *feature.values.back();
  const std::optional<LinearRgb> color = scene::ParseHexColor(std::string(files::Trimmed(text)));
  if (color) return color;
  return BadValue(drape, feature, drape.ink.color_field, text, "color",
                  "write it as sRGB, for example #d02010");
}

/// What a drape's attributes and shapes say of each feature.
struct FeatureFacts {
  std::vector<double> above_m;
  std::size_t without_height = 0;
};

Result<FeatureFacts> ReadFacts(const scene::DrapeDescription& drape,
                               const std::vector<VectorLayer>& layers, MapLines* map) {
  FeatureFacts facts;
  std::string empty;
  std::size_t empties = 0;
  for (const VectorLayer& layer : layers) {
    for (const MapFeature& feature : layer.features) {
      PLEINAIR_ASSIGN_OR_RETURN(const double height_m, HeightOf(drape, feature));
      facts.above_m.push_back(height_m + drape.offset_m);
      if (HasHeightField(drape) && !feature.values.front()) ++facts.without_height;
      if (!drape.ink.color_field.empty()) {
        PLEINAIR_ASSIGN_OR_RETURN(const auto color, ColorOf(drape, feature));
        map->colors.push_back(color);
      }
      const std::string number = std::to_string(feature.number);
      if (feature.mended) {
        map->warnings.push_back("feature " + number +
                                " has rings that cross themselves; they are mended");
      }
      if (feature.parts.empty()) {
        if (empties++ == 0) empty = number;
      } else if (HasOwnHeights(drape) && !feature.has_heights) {
        return InputError(drape.source.file.string(), "feature " + number + " has no heights",
                          "leave height_field = \"z\" out, or export the map with heights");
      }
    }
  }
  map->features = facts.above_m.size();
  if (empties > 0) {
    map->warnings.push_back(std::to_string(empties) + " features have no geometry, the first is " +
                            empty);
  }
  if (facts.without_height > 0) {
    map->warnings.push_back(std::to_string(facts.without_height) + " features have no value in \"" +
                            drape.height_field + "\"; they lie on the surface");
  }
  return facts;
}

/// Coordinates that are metres of the marker.
void AddMarkerLines(const scene::SceneDescription& scene, const std::vector<VectorLayer>& layers,
                    MapLines* map) {
  const Mat3 world_from_marker = scene::MarkerFromWorld(scene.marker).Transposed();
  const content::Place place = PlaceOfMarker(scene);
  map->frame = content::LocalFrame({place.longitude_deg, place.latitude_deg, place.height_m});
  map->crs = scene::kMarkerCrs;
  for (const VectorLayer& layer : layers) {
    for (const MapFeature& feature : layer.features) {
      for (const content::GeometryPart& part : feature.parts) {
        LineToDrape line;
        line.feature = static_cast<std::uint32_t>(feature.number);
        line.kind = part.kind;
        line.points.reserve(part.points.size());
        for (content::MapPoint point : part.points) {
          if (!feature.has_heights) point.z = 0.0;
          line.points.push_back({world_from_marker * point});
        }
        map->lines.push_back(std::move(line));
      }
    }
  }
}

/// Moves each vertex along its plumb line.
void MoveToSurface(const content::SurfaceIndex& surface, const content::SurfaceRule& rule,
                   content::PlacedLayer* layer) {
  std::vector<content::PlacedPart*> parts;
  for (content::PlacedFeature& feature : layer->features) {
    for (content::PlacedPart& part : feature.parts) parts.push_back(&part);
  }
  ParallelFor(parts.size(), 0, [&](std::size_t i) {
    content::MoveAlongPlumbLines(layer->frame, surface, rule, parts[i]->geodetic, parts[i]->points);
  });
}

/// Coordinates of a coordinate reference system.
Result<void> AddPlacedLines(const scene::SceneDescription& scene,
                            const scene::DrapeDescription& drape, std::vector<VectorLayer> layers,
                            const content::SurfaceIndex& surface, MapLines* map) {
  const std::string where = drape.source.file.string();
  for (VectorLayer& layer : layers) {
    if (layer.crs.empty() && drape.source.crs.empty()) {
      return InputError(where, "states no coordinate reference system",
                        "add it to the [[drape]], for example crs = \"EPSG:32633\"");
    }
    if (drape.source.crs.empty()) continue;
    if (!layer.crs.empty()) {
      map->warnings.push_back("layer \"" + layer.name + "\" states " + layer.crs_name +
                              "; the crs of the scene is used in its place");
    }
    layer.crs = drape.source.crs;
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      std::vector<content::PlacedLayer> placed,
      content::PlaceLayers(layers, "", PlaceOfMarker(scene), map->options.radius_m, where));
  layers.clear();
  for (content::PlacedLayer& layer : placed) {
    map->crs = layer.facts.crs;
    map->frame = layer.frame;
    for (const std::string& warning : TransformWarnings(layer.facts)) {
      map->warnings.push_back(warning);
    }
    if (!map->options.own_heights) MoveToSurface(surface, map->options.on, &layer);
    for (content::PlacedFeature& feature : layer.features) {
      for (content::PlacedPart& part : feature.parts) {
        LineToDrape line;
        line.feature = static_cast<std::uint32_t>(feature.number);
        line.kind = part.kind;
        line.points = std::move(part.points);
        part.geodetic = {};
        map->lines.push_back(std::move(line));
      }
    }
  }
  return {};
}

}  // namespace

Result<std::vector<VectorLayer>> ReadMap(const scene::DrapeDescription& drape) {
  content::VectorQuery query;
  if (!drape.source.layer.empty()) query.layer = drape.source.layer;
  query.where = drape.source.where;
  if (HasHeightField(drape)) query.fields.push_back(drape.height_field);
  if (!drape.ink.color_field.empty()) query.fields.push_back(drape.ink.color_field);
  query.mend_areas = true;
  return content::ReadVectorLayers(drape.source.file, query);
}

Result<MapLines> PlaceMap(const scene::SceneDescription& scene,
                          const scene::DrapeDescription& drape, std::vector<VectorLayer> layers,
                          const content::SurfaceIndex& surface, std::uint32_t first_feature) {
  MapLines map;
  map.options.on = RuleOf(drape, scene);
  map.options.own_heights = HasOwnHeights(drape);
  PLEINAIR_ASSIGN_OR_RETURN(const FeatureFacts facts, ReadFacts(drape, layers, &map));
  if (drape.source.crs == scene::kMarkerCrs) {
    AddMarkerLines(scene, layers, &map);
  } else {
    PLEINAIR_RETURN_IF_ERROR(AddPlacedLines(scene, drape, std::move(layers), surface, &map));
  }
  for (LineToDrape& line : map.lines) {
    line.above_m = facts.above_m[line.feature];
    line.feature += first_feature;
  }
  return map;
}

}  // namespace pleinair::app
