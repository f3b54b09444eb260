#include "content/georeference/map_transform.h"

#include <array>
#include <cmath>
#include <utility>

#include "content/georeference/coordinate_system.h"
#include "content/georeference/operation_choice.h"
#include "content/georeference/proj_handles.h"

namespace pleinair::content {
namespace {

// Magnitudes beyond are no metres, feet or degrees on Earth, and may overflow in PROJ.
constexpr double kMaxCoordinate = 1e9;

std::optional<GeodeticPoint> Transformed(PJ* operation, const Vec3& point) {
  for (const double value : {point.x, point.y, point.z}) {
    if (!std::isfinite(value) || std::fabs(value) > kMaxCoordinate) return std::nullopt;
  }
  proj_errno_reset(operation);
  const PJ_COORD out =
      proj_trans(operation, PJ_FWD, proj_coord(point.x, point.y, point.z, HUGE_VAL));
  const GeodeticPoint geodetic{out.xyz.x, out.xyz.y, out.xyz.z};
  if (proj_errno(operation) != 0 || !std::isfinite(geodetic.longitude_deg) ||
      !(std::fabs(geodetic.latitude_deg) <= 90.0) || !std::isfinite(geodetic.height_m)) {
    return std::nullopt;
  }
  return GeodeticPoint{std::remainder(geodetic.longitude_deg, 360.0), geodetic.latitude_deg,
                       geodetic.height_m};
}

/// Height of the geoid above the ellipsoid at a place.
struct Geoid {
  std::string name;
  double undulation_m = 0.0;
};

Result<Geoid> GeoidAt(PJ_CONTEXT* context, const GeodeticPoint& place, const std::string& where) {
  // The finer geoid first; Debian's proj-data contains the second one.
  constexpr std::array<const char*, 2> kGeoids = {"EPSG:4326+3855", "EPSG:4326+5773"};
  Error error;
  for (const char* code : kGeoids) {
    PLEINAIR_ASSIGN_OR_RETURN(const CoordinateSystem sea,
                              ParseCoordinateSystem(context, code, where));
    PLEINAIR_ASSIGN_OR_RETURN(const CoordinateSystem wgs84,
                              ParseCoordinateSystem(context, "EPSG:4979", where));
    const auto operation =
        ChooseOperation(context, sea, wgs84, place, Heights::kTransformed, where);
    if (!operation) {
      error = operation.error();
      continue;
    }
    const auto at =
        Transformed(operation->object.get(), {place.longitude_deg, place.latitude_deg, 0.0});
    if (at) return Geoid{sea.vertical_name, at->height_m};
  }
  error.remedy =
      GridRemedy("us_nga_egm96_15.tif") + ", or give the height of the place above the ellipsoid";
  return tl::make_unexpected(std::move(error));
}

bool IsOnEarth(const Place& place) {
  return std::fabs(place.latitude_deg) <= 90.0 && std::fabs(place.longitude_deg) <= 180.0 &&
         std::fabs(place.height_m) <= 100'000.0;
}

}  // namespace

struct MapTransform::Parts {
  ProjContext context;
  CoordinateSystem crs;
  ChosenOperation operation;
  LocalFrame frame{GeodeticPoint{}};
  TransformFacts facts;
};

MapTransform::MapTransform(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
MapTransform::~MapTransform() = default;
MapTransform::MapTransform(MapTransform&&) noexcept = default;
MapTransform& MapTransform::operator=(MapTransform&&) noexcept = default;

Result<MapTransform> MapTransform::Create(const std::string& crs, const Place& place,
                                          const std::string& where) {
  if (!IsOnEarth(place)) {
    return InputError(where, "the place of the marker is not on Earth",
                      "give latitude -90 to 90 and longitude -180 to 180 degrees");
  }
  auto parts = std::make_unique<Parts>();
  parts->context = MakeProjContext();
  PJ_CONTEXT* context = parts->context.get();
  PLEINAIR_ASSIGN_OR_RETURN(parts->crs, ParseCoordinateSystem(context, crs, where));
  const bool heights = parts->crs.states_heights;
  PLEINAIR_ASSIGN_OR_RETURN(
      const CoordinateSystem target,
      ParseCoordinateSystem(context, heights ? "EPSG:4979" : "EPSG:4326", where));
  GeodeticPoint origin{place.longitude_deg, place.latitude_deg, place.height_m};
  PLEINAIR_ASSIGN_OR_RETURN(
      parts->operation, ChooseOperation(context, parts->crs, target, origin,
                                        heights ? Heights::kTransformed : Heights::kKept, where));
  TransformFacts& facts = parts->facts;
  facts.crs = parts->crs.name;
  facts.operation = parts->operation.name;
  facts.accuracy_m = parts->operation.accuracy_m;
  facts.datum_unknown = parts->operation.ballpark;
  facts.missing_grids = parts->operation.missing_grids;
  facts.place_outside_area = parts->crs.area && !parts->crs.area->Contains(origin);
  if (parts->crs.area) facts.area = parts->crs.area->name;
  if (heights) {
    facts.heights = HeightDatum::kTransformed;
    facts.vertical = parts->crs.vertical_name.empty() ? "ellipsoid" : parts->crs.vertical_name;
    if (place.reference == HeightReference::kSeaLevel) {
      PLEINAIR_ASSIGN_OR_RETURN(const Geoid geoid, GeoidAt(context, origin, where));
      facts.undulation_m = geoid.undulation_m;
      facts.geoid = geoid.name;
      origin.height_m += geoid.undulation_m;
    }
  }
  parts->frame = LocalFrame(origin);
  return MapTransform(std::move(parts));
}

std::optional<GeodeticPoint> MapTransform::Geodetic(const MapPoint& point) const {
  return Transformed(parts_->operation.object.get(), point);
}

std::optional<Point<World>> MapTransform::EastNorthUp(const MapPoint& point) const {
  const std::optional<GeodeticPoint> geodetic = Geodetic(point);
  if (!geodetic) return std::nullopt;
  return parts_->frame.EastNorthUp(*geodetic);
}

std::optional<MapPoint> MapTransform::OnMap(const GeodeticPoint& point) const {
  PJ* const operation = parts_->operation.object.get();
  proj_errno_reset(operation);
  const PJ_COORD out =
      proj_trans(operation, PJ_INV,
                 proj_coord(point.longitude_deg, point.latitude_deg, point.height_m, HUGE_VAL));
  const MapPoint on_map{out.xyz.x, out.xyz.y, out.xyz.z};
  if (proj_errno(operation) != 0 || !std::isfinite(on_map.x + on_map.y + on_map.z)) {
    return std::nullopt;
  }
  return on_map;
}

bool MapTransform::InArea(const GeodeticPoint& point) const {
  return !parts_->crs.area || parts_->crs.area->Contains(point);
}

const TransformFacts& MapTransform::facts() const { return parts_->facts; }
const LocalFrame& MapTransform::frame() const { return parts_->frame; }
bool MapTransform::geographic() const { return parts_->crs.geographic; }

}  // namespace pleinair::content
