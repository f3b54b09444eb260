#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "content/georeference/map_transform.h"
#include "content/georeference/vector_layer.h"

namespace pleinair::content {

/// A part with its vertices in the tangent frame of the place.
struct PlacedPart {
  PartKind kind = PartKind::kPoint;
  std::vector<Point<World>> points;
  std::vector<GeodeticPoint> geodetic;
};

/// Bounds of points, metres east, north and up.
struct WorldBounds {
  Vec3 min, max;
  bool empty = true;

  void Include(const Vec3& point);
  void Include(const WorldBounds& other);
};

/// A feature as it stands around the marker. Distances are horizontal: hypot(east, north).
struct PlacedFeature {
  std::size_t number = 0;
  std::string name;
  bool has_heights = false;  ///< False: it stands at the height of the marker.
  std::vector<PlacedPart> parts;
  WorldBounds bounds;
  bool surrounds_marker = false;     ///< The marker lies inside the area; nearest_m is then 0.
  double nearest_m = 0.0;            ///< All points of its lines and areas count.
  double nearest_azimuth_deg = 0.0;  ///< Clockwise from true north, 0…360.
  double farthest_m = 0.0;           ///< Its vertices count.
  double farthest_azimuth_deg = 0.0;
};

struct PlacedLayer {
  std::string name;
  std::string crs_name;
  TransformFacts facts;
  LocalFrame frame{GeodeticPoint{}};    ///< That the features stand in.
  std::vector<PlacedFeature> features;  ///< Those with geometry.
  std::size_t empty_features = 0;       ///< Without geometry, or without vertices.
  std::size_t vertices = 0;
  std::size_t vertices_outside_area = 0;  ///< Outside the area of use of the CRS.
};

/// Transforms all vertices of the layers. `crs` replaces those of the layers unless it is empty.
/// Errors (input): a layer without CRS; those of MapTransform; those of CheckNear(). The CRS is not
/// defined at a vertex: the error has the feature's number.
Result<std::vector<PlacedLayer>> PlaceLayers(std::span<const VectorLayer> layers,
                                             const std::string& crs, const Place& place,
                                             double radius_m, const std::string& where);

}  // namespace pleinair::content
