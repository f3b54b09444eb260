#include "content/georeference/placed_features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/units.h"
#include "content/georeference/nearness.h"

namespace pleinair::content {
namespace {

double AzimuthOf(Vec2 point) {
  const double azimuth_deg = ToDegrees(Radians(std::atan2(point.x, point.y)));
  return azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg;
}

Vec2 Horizontal(const Point<World>& point) { return {point.xyz.x, point.xyz.y}; }

/// The point of the segment a, b that is nearest to the origin.
Vec2 NearestOnSegment(Vec2 a, Vec2 b) {
  const Vec2 way = b - a;
  const double square = way.x * way.x + way.y * way.y;
  if (!(square > 0.0)) return a;
  const double share = std::clamp(-(a.x * way.x + a.y * way.y) / square, 0.0, 1.0);
  return a + way * share;
}

/// True if a ray from the origin to the east crosses the segment.
bool CrossesEastwards(Vec2 a, Vec2 b) {
  if ((a.y > 0.0) == (b.y > 0.0)) return false;
  return a.x + (b.x - a.x) * (-a.y / (b.y - a.y)) > 0.0;
}

void Measure(PlacedFeature* feature) {
  Vec2 nearest, farthest;
  double nearest_m = std::numeric_limits<double>::infinity(), farthest_m = -1.0;
  bool inside = false;
  const auto try_nearest = [&](Vec2 point) {
    if (Norm(point) < nearest_m) nearest = point, nearest_m = Norm(point);
  };
  for (const PlacedPart& part : feature->parts) {
    for (std::size_t i = 0; i < part.points.size(); ++i) {
      const Vec2 at = Horizontal(part.points[i]);
      feature->bounds.Include(part.points[i].xyz);
      if (Norm(at) > farthest_m) farthest = at, farthest_m = Norm(at);
      try_nearest(at);
      if (i == 0 || part.kind == PartKind::kPoint) continue;
      const Vec2 before = Horizontal(part.points[i - 1]);
      try_nearest(NearestOnSegment(before, at));
      if (part.kind == PartKind::kRing && CrossesEastwards(before, at)) inside = !inside;
    }
  }
  feature->surrounds_marker = inside;
  feature->nearest_m = inside ? 0.0 : nearest_m;
  feature->nearest_azimuth_deg = inside ? 0.0 : AzimuthOf(nearest);
  feature->farthest_m = farthest_m;
  feature->farthest_azimuth_deg = AzimuthOf(farthest);
}

Result<PlacedFeature> PlaceFeature(const MapFeature& feature, const MapTransform& transform,
                                   const std::string& where, PlacedLayer* layer) {
  PlacedFeature placed;
  placed.number = feature.number;
  placed.name = feature.name;
  placed.has_heights = feature.has_heights;
  placed.parts.reserve(feature.parts.size());
  for (const GeometryPart& part : feature.parts) {
    PlacedPart& out = placed.parts.emplace_back();
    out.kind = part.kind;
    out.points.reserve(part.points.size());
    out.geodetic.reserve(part.points.size());
    for (const MapPoint& point : part.points) {
      std::optional<GeodeticPoint> geodetic = transform.Geodetic(point);
      if (!geodetic) {
        return InputError(where,
                          "feature " + std::to_string(feature.number) +
                              " has a vertex that has no position in " + transform.facts().crs,
                          "check the coordinate reference system, or repair that feature");
      }
      if (!feature.has_heights) geodetic->height_m = transform.frame().origin().height_m;
      if (!transform.InArea(*geodetic)) ++layer->vertices_outside_area;
      out.points.push_back(transform.frame().EastNorthUp(*geodetic));
      out.geodetic.push_back(*geodetic);
    }
    layer->vertices += part.points.size();
  }
  Measure(&placed);
  return placed;
}

PlacedLayer EmptyLayer(const VectorLayer& layer, const MapTransform& transform) {
  PlacedLayer placed;
  placed.name = layer.name;
  placed.crs_name = transform.facts().crs;
  placed.facts = transform.facts();
  placed.frame = transform.frame();
  placed.empty_features = layer.features.size();
  return placed;
}

Result<PlacedLayer> PlaceLayer(const VectorLayer& layer, const MapTransform& transform,
                               const std::string& where) {
  PlacedLayer placed = EmptyLayer(layer, transform);
  placed.empty_features = 0;
  placed.features.reserve(layer.features.size());
  for (const MapFeature& feature : layer.features) {
    if (feature.parts.empty()) {
      ++placed.empty_features;
      continue;
    }
    PLEINAIR_ASSIGN_OR_RETURN(PlacedFeature at, PlaceFeature(feature, transform, where, &placed));
    placed.features.push_back(std::move(at));
  }
  return placed;
}

std::vector<MapPoint> PointsOf(const VectorLayer& layer) {
  std::vector<MapPoint> points;
  for (const MapFeature& feature : layer.features) {
    for (const GeometryPart& part : feature.parts) {
      points.insert(points.end(), part.points.begin(), part.points.end());
    }
  }
  return points;
}

/// True if a line or area comes near although none of its vertices does. Content on the other side
/// of the Earth lies deep below the tangent plane.
bool ComesNear(const PlacedLayer& layer, double radius_m) {
  constexpr double kThisSideOfEarth_m = -1e6;
  return std::any_of(layer.features.begin(), layer.features.end(), [&](const PlacedFeature& each) {
    return each.nearest_m <= radius_m && each.bounds.min.z > kThisSideOfEarth_m;
  });
}

}  // namespace

void WorldBounds::Include(const Vec3& point) {
  if (std::exchange(empty, false)) min = max = point;
  min = {std::min(min.x, point.x), std::min(min.y, point.y), std::min(min.z, point.z)};
  max = {std::max(max.x, point.x), std::max(max.y, point.y), std::max(max.z, point.z)};
}

void WorldBounds::Include(const WorldBounds& other) {
  if (other.empty) return;
  Include(other.min);
  Include(other.max);
}

Result<std::vector<PlacedLayer>> PlaceLayers(std::span<const VectorLayer> layers,
                                             const std::string& crs, const Place& place,
                                             double radius_m, const std::string& where) {
  std::vector<PlacedLayer> placed;
  placed.reserve(layers.size());
  bool near = false;
  // Far content is reported first: undefined positions often follow from swapped axes.
  Result<void> too_far, undefined;
  for (const VectorLayer& layer : layers) {
    const std::string& text = crs.empty() ? layer.crs : crs;
    if (text.empty()) {
      return InputError(where, "states no coordinate reference system",
                        "give it with --crs, for example --crs EPSG:32633");
    }
    PLEINAIR_ASSIGN_OR_RETURN(const MapTransform transform,
                              MapTransform::Create(text, place, crs.empty() ? where : "--crs"));
    const std::vector<MapPoint> points = PointsOf(layer);
    if (points.empty()) {
      placed.push_back(EmptyLayer(layer, transform));
      continue;
    }
    const Result<void> checked = CheckNear(transform, points, radius_m, where);
    if (!checked && too_far) too_far = checked;
    auto at = PlaceLayer(layer, transform, where);
    if (!at) {
      if (undefined) undefined = tl::make_unexpected(std::move(at).error());
      near = near || checked.has_value();
      continue;
    }
    near = near || checked.has_value() || ComesNear(*at, radius_m);
    placed.push_back(*std::move(at));
  }
  if (!near && !too_far) return tl::make_unexpected(std::move(too_far).error());
  if (!undefined) return tl::make_unexpected(std::move(undefined).error());
  return placed;
}

}  // namespace pleinair::content
