#include "app/place/placement.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/place/transform_warnings.h"
#include "content/georeference/nearness.h"

namespace pleinair::app {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMaxListed = 30;  // Rows of the table for people.

ordered_json Range(double low, double high) { return ordered_json::array({low, high}); }

ordered_json BoundsJson(const content::WorldBounds& bounds) {
  return {{"east_m", Range(bounds.min.x, bounds.max.x)},
          {"north_m", Range(bounds.min.y, bounds.max.y)},
          {"up_m", Range(bounds.min.z, bounds.max.z)}};
}

content::WorldBounds MarkerBounds(const content::PlacedFeature& feature,
                                  const Mat3& marker_from_world) {
  content::WorldBounds bounds;
  for (const content::PlacedPart& part : feature.parts) {
    for (const Point<World>& point : part.points) bounds.Include(marker_from_world * point.xyz);
  }
  return bounds;
}

ordered_json FeatureJson(const content::PlacedFeature& feature, const std::string& layer,
                         const Placement& placement) {
  ordered_json json{{"feature", feature.number}, {"layer", layer}, {"kind", KindOf(feature)}};
  if (!feature.name.empty()) json["name"] = feature.name;
  json.update(BoundsJson(feature.bounds));
  if (placement.marker_from_world) {
    const content::WorldBounds bounds = MarkerBounds(feature, *placement.marker_from_world);
    json["marker_x_m"] = Range(bounds.min.x, bounds.max.x);
    json["marker_y_m"] = Range(bounds.min.y, bounds.max.y);
    json["marker_z_m"] = Range(bounds.min.z, bounds.max.z);
  }
  json["has_heights"] = feature.has_heights;
  json["surrounds_marker"] = feature.surrounds_marker;
  json["nearest"] = {{"distance_m", feature.nearest_m},
                     {"azimuth_deg", feature.nearest_azimuth_deg}};
  json["farthest"] = {{"distance_m", feature.farthest_m},
                      {"azimuth_deg", feature.farthest_azimuth_deg}};
  json["beyond_radius"] = feature.nearest_m > placement.radius_m;
  return json;
}

ordered_json LayerJson(const content::PlacedLayer& layer) {
  const content::TransformFacts& facts = layer.facts;
  ordered_json json{{"layer", layer.name},
                    {"crs", facts.crs},
                    {"operation", facts.operation},
                    {"accuracy_m", facts.accuracy_m},
                    {"datum_unknown", facts.datum_unknown},
                    {"missing_grids", facts.missing_grids}};
  const bool shared = facts.heights == content::HeightDatum::kShared;
  json["heights"] = shared ? "shared" : "transformed";
  json["vertical"] = facts.vertical.empty() ? ordered_json() : ordered_json(facts.vertical);
  json["undulation_m"] = facts.undulation_m ? ordered_json(*facts.undulation_m) : ordered_json();
  json["geoid"] = facts.geoid.empty() ? ordered_json() : ordered_json(facts.geoid);
  json["features"] = layer.features.size();
  json["empty_features"] = layer.empty_features;
  json["vertices"] = layer.vertices;
  json["vertices_outside_area"] = layer.vertices_outside_area;
  return json;
}

std::string HeightText(const content::TransformFacts& facts) {
  if (facts.heights == content::HeightDatum::kShared) {
    return "heights are taken to have the reference of the place: the map states none";
  }
  std::string text = "heights of the map: " + facts.vertical;
  if (facts.undulation_m) {
    text += fmt::format("; {} lies {:+.2f} m from the ellipsoid at the place", facts.geoid,
                        *facts.undulation_m);
  }
  return text;
}

std::string Way(double distance_m, double azimuth_deg) {
  return fmt::format("{:.2f} m {} ({:.1f} degrees)", distance_m, content::CompassPoint(azimuth_deg),
                     azimuth_deg);
}

std::string FeatureRow(const content::PlacedFeature& feature) {
  const content::WorldBounds& b = feature.bounds;
  const std::string nearest =
      feature.surrounds_marker
          ? "around the marker"
          : fmt::format("{:.2f} at {:.1f}", feature.nearest_m, feature.nearest_azimuth_deg);
  return fmt::format(
      "{:>7}  {:<6}  {:<17}  {:>10.2f}  {:>9.2f} {:>9.2f}  {:>9.2f} {:>9.2f}  "
      "{:>8.2f} {:>8.2f}  {}\n",
      feature.number, KindOf(feature), nearest, feature.farthest_m, b.min.x, b.max.x, b.min.y,
      b.max.y, b.min.z, b.max.z, feature.name);
}

}  // namespace

PlacementSummary Summarize(const Placement& placement) {
  PlacementSummary summary;
  for (const content::PlacedLayer& layer : placement.layers) {
    summary.empty_features += layer.empty_features;
    summary.vertices += layer.vertices;
    for (const content::PlacedFeature& feature : layer.features) {
      ++summary.features;
      if (!summary.nearest || feature.nearest_m < summary.nearest->nearest_m) {
        summary.nearest = &feature;
      }
      if (feature.nearest_m > placement.radius_m) {
        ++summary.beyond_radius;
        continue;
      }
      summary.bounds.Include(feature.bounds);
      if (!summary.farthest || feature.farthest_m > summary.farthest->farthest_m) {
        summary.farthest = &feature;
      }
    }
  }
  return summary;
}

std::string KindOf(const content::PlacedFeature& feature) {
  std::set<content::PartKind> kinds;
  for (const content::PlacedPart& part : feature.parts) kinds.insert(part.kind);
  if (kinds.size() != 1) return "mixed";
  switch (*kinds.begin()) {
    case content::PartKind::kPoint:
      return feature.parts.size() > 1 ? "points" : "point";
    case content::PartKind::kLine:
      return feature.parts.size() > 1 ? "lines" : "line";
    case content::PartKind::kRing:
      break;
  }
  return "area";
}

std::string PlacementText(const Placement& placement) {
  const PlacementSummary summary = Summarize(placement);
  std::string text = fmt::format("{}: {} features, {} vertices\n", placement.file, summary.features,
                                 summary.vertices);
  for (const content::PlacedLayer& layer : placement.layers) {
    text += fmt::format("  layer \"{}\": {}\n    {}\n", layer.name, layer.facts.crs,
                        HeightText(layer.facts));
    if (layer.facts.accuracy_m > 0.0) {
      text += fmt::format("    {}: accurate to {:g} m\n", layer.facts.operation,
                          layer.facts.accuracy_m);
    }
  }
  if (!summary.nearest) return text;
  const content::WorldBounds& b = summary.bounds;
  text += fmt::format(
      "  from the marker: east {:.2f} to {:.2f}, north {:.2f} to {:.2f}, up {:.2f} "
      "to {:.2f} m\n",
      b.min.x, b.max.x, b.min.y, b.max.y, b.min.z, b.max.z);
  text += fmt::format("  nearest: feature {}, {}\n", summary.nearest->number,
                      summary.nearest->surrounds_marker
                          ? "an area around the marker"
                          : Way(summary.nearest->nearest_m, summary.nearest->nearest_azimuth_deg));
  if (summary.farthest) {
    text += fmt::format("  farthest: feature {}, {}\n", summary.farthest->number,
                        Way(summary.farthest->farthest_m, summary.farthest->farthest_azimuth_deg));
  }
  text +=
      "feature  kind    nearest_m at deg   farthest_m      east_m min, max     north_m min, max"
      "      up_m min, max  name\n";
  std::size_t rows = 0;
  for (const content::PlacedLayer& layer : placement.layers) {
    for (const content::PlacedFeature& feature : layer.features) {
      if (rows++ < kMaxListed) text += FeatureRow(feature);
    }
  }
  if (rows > kMaxListed) {
    text += fmt::format("and {} more; --json lists all\n", rows - kMaxListed);
  }
  return text;
}

std::string PlacementJson(const Placement& placement) {
  const PlacementSummary summary = Summarize(placement);
  ordered_json json{
      {"file", placement.file},
      {"place",
       {{"latitude_deg", placement.place.latitude_deg},
        {"longitude_deg", placement.place.longitude_deg},
        {"height_m", placement.place.height_m},
        {"height_reference",
         placement.place.reference == content::HeightReference::kSeaLevel ? "sea" : "ellipsoid"}}},
      {"radius_m", placement.radius_m},
      {"layers", ordered_json::array()},
      {"vertices", summary.vertices},
      {"empty_features", summary.empty_features},
      {"beyond_radius", summary.beyond_radius}};
  json["bounds"] = summary.bounds.empty ? ordered_json() : BoundsJson(summary.bounds);
  if (summary.nearest) {
    json["nearest"] = {{"feature", summary.nearest->number},
                       {"distance_m", summary.nearest->nearest_m},
                       {"azimuth_deg", summary.nearest->nearest_azimuth_deg}};
  }
  if (summary.farthest) {
    json["farthest"] = {{"feature", summary.farthest->number},
                        {"distance_m", summary.farthest->farthest_m},
                        {"azimuth_deg", summary.farthest->farthest_azimuth_deg}};
  }
  json["warnings"] = PlacementWarnings(placement);
  json["features"] = ordered_json::array();
  for (const content::PlacedLayer& layer : placement.layers) {
    json["layers"].push_back(LayerJson(layer));
    for (const content::PlacedFeature& feature : layer.features) {
      json["features"].push_back(FeatureJson(feature, layer.name, placement));
    }
  }
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string PlacementCsv(const Placement& placement) {
  const auto& rotation = placement.marker_from_world;
  std::string text = "feature,part,vertex,east_m,north_m,up_m,lon_deg,lat_deg,height_m";
  text += rotation ? ",x_m,y_m,z_m\n" : "\n";
  for (const content::PlacedLayer& layer : placement.layers) {
    for (const content::PlacedFeature& feature : layer.features) {
      for (std::size_t part = 0; part < feature.parts.size(); ++part) {
        const content::PlacedPart& each = feature.parts[part];
        for (std::size_t i = 0; i < each.points.size(); ++i) {
          const Vec3& enu = each.points[i].xyz;
          const content::GeodeticPoint& at = each.geodetic[i];
          text += fmt::format("{},{},{},{:.6f},{:.6f},{:.6f},{:.10f},{:.10f},{:.6f}",
                              feature.number, part, i, enu.x, enu.y, enu.z, at.longitude_deg,
                              at.latitude_deg, at.height_m);
          if (rotation) {
            const Vec3 marker = *rotation * enu;
            text += fmt::format(",{:.6f},{:.6f},{:.6f}", marker.x, marker.y, marker.z);
          }
          text += '\n';
        }
      }
    }
  }
  return text;
}

std::vector<std::string> PlacementWarnings(const Placement& placement) {
  std::vector<std::string> warnings;
  const PlacementSummary summary = Summarize(placement);
  for (const content::PlacedLayer& layer : placement.layers) {
    const content::TransformFacts& facts = layer.facts;
    const std::string name = "layer \"" + layer.name + "\": ";
    for (const std::string& warning : TransformWarnings(facts)) warnings.push_back(name + warning);
    if (!facts.place_outside_area && layer.vertices_outside_area > 0) {
      warnings.push_back(
          name + fmt::format("{} of {} vertices lie outside the area of use of {}, {}",
                             layer.vertices_outside_area, layer.vertices, facts.crs, facts.area));
    }
    if (layer.empty_features > 0) {
      warnings.push_back(name + fmt::format("{} features have no geometry", layer.empty_features));
    }
  }
  if (summary.beyond_radius > 0) {
    warnings.push_back(
        fmt::format("{} of {} features are farther than {:g} m; --radius changes that",
                    summary.beyond_radius, summary.features, placement.radius_m));
  }
  return warnings;
}

}  // namespace pleinair::app
