#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vector.h"
#include "content/georeference/placed_features.h"

namespace pleinair::app {

/// The layers of a map file around a marker: what `pleinair place` reports.
struct Placement {
  std::string file;
  content::Place place;
  double radius_m = 0.0;
  std::vector<content::PlacedLayer> layers;
  /// Rotation to marker coordinates, of the scene; unset: no scene is given.
  std::optional<Mat3> marker_from_world;
};

/// What all layers together have.
struct PlacementSummary {
  std::size_t features = 0, empty_features = 0, vertices = 0;
  std::size_t beyond_radius = 0;  ///< Features whose nearest point is farther than the radius.
  content::WorldBounds bounds;    ///< Around the features that are not beyond.
  const content::PlacedFeature* nearest = nullptr;   ///< Null: no feature has a geometry.
  const content::PlacedFeature* farthest = nullptr;  ///< Among those that are not beyond.
};

PlacementSummary Summarize(const Placement& placement);

/// "point", "line", "area", or "points", "lines", "areas" for several of a kind, "mixed".
std::string KindOf(const content::PlacedFeature& feature);

/// The report for people, and as one JSON object (docs/guide/maps.md).
std::string PlacementText(const Placement& placement);
std::string PlacementJson(const Placement& placement);

/// A CSV row per vertex, with a header (docs/guide/maps.md).
std::string PlacementCsv(const Placement& placement);

/// Assumptions that can make the places wrong, one line each.
std::vector<std::string> PlacementWarnings(const Placement& placement);

}  // namespace pleinair::app
