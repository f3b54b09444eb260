#include "content/georeference/coordinate_system.h"

namespace pleinair::content {
namespace {

constexpr const char* kCrsRemedy =
    "give a code as EPSG:32633, WKT, or a PROJ string as \"+proj=utm +zone=33 +datum=WGS84\"";
constexpr std::size_t kMaxCrsText = 100'000;  // WKT with its metadata has some thousand bytes.

std::string CodeOf(const PJ* object) {
  const char* authority = proj_get_id_auth_name(object, 0);
  const char* code = proj_get_id_code(object, 0);
  return authority && code ? std::string(authority) + ":" + code : std::string();
}

std::string NameOf(const PJ* object) {
  const char* name = proj_get_name(object);
  return name ? name : "unknown";
}

/// The CRS without its transformation to WGS 84 (BoundCRS).
ProjObject WithoutBinding(PJ_CONTEXT* context, const PJ* object) {
  ProjObject inner(proj_clone(context, object));
  while (inner && proj_get_type(inner.get()) == PJ_TYPE_BOUND_CRS) {
    inner.reset(proj_get_source_crs(context, inner.get()));
  }
  return inner;
}

int AxisCount(PJ_CONTEXT* context, const PJ* crs) {
  const ProjObject system(proj_crs_get_coordinate_system(context, crs));
  return system ? proj_cs_get_axis_count(context, system.get()) : 0;
}

bool IsGeographic(PJ_TYPE type) {
  return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}

}  // namespace

bool AreaOfUse::Contains(const GeodeticPoint& point) const {
  if (point.latitude_deg < south_deg || point.latitude_deg > north_deg) return false;
  const bool east_of_west = point.longitude_deg >= west_deg;
  const bool west_of_east = point.longitude_deg <= east_deg;
  return west_deg <= east_deg ? east_of_west && west_of_east : east_of_west || west_of_east;
}

Result<CoordinateSystem> ParseCoordinateSystem(PJ_CONTEXT* context, const std::string& text,
                                               const std::string& where) {
  const std::string shown = "\"" + text.substr(0, 60) + "\"";
  if (text.size() > kMaxCrsText || text.find('\0') != std::string::npos) {
    return InputError(where, "the coordinate reference system is too long or not text", kCrsRemedy);
  }
  if (text.find("proj=pipeline") != std::string::npos) {
    return InputError(where, shown + " is an operation between two systems", kCrsRemedy);
  }
  // PROJ strings are coordinate operations unless they say otherwise.
  const bool proj_string = text.find("proj=") != std::string::npos &&
                           text.find("type=crs") == std::string::npos &&
                           text.find('[') == std::string::npos;
  const std::string definition = proj_string ? text + " +type=crs" : text;
  CoordinateSystem crs;
  crs.object.reset(proj_create(context, definition.c_str()));
  if (!crs.object || !proj_is_crs(crs.object.get())) {
    return InputError(where, shown + " is no coordinate reference system that PROJ knows",
                      kCrsRemedy);
  }
  const ProjObject plain = WithoutBinding(context, crs.object.get());
  if (!plain) return InputError(where, shown + " cannot be read", kCrsRemedy);
  PJ_TYPE type = proj_get_type(plain.get());
  if (type == PJ_TYPE_ENGINEERING_CRS || type == PJ_TYPE_VERTICAL_CRS ||
      type == PJ_TYPE_TEMPORAL_CRS) {
    return InputError(where, shown + " has no horizontal position on Earth", kCrsRemedy);
  }
  const std::string code = CodeOf(plain.get());
  crs.name = NameOf(plain.get()) + (code.empty() ? "" : " (" + code + ")");
  if (type == PJ_TYPE_COMPOUND_CRS) {
    crs.states_heights = true;
    const ProjObject horizontal(proj_crs_get_sub_crs(context, plain.get(), 0));
    const ProjObject vertical(proj_crs_get_sub_crs(context, plain.get(), 1));
    if (vertical) crs.vertical_name = NameOf(vertical.get());
    if (horizontal) {
      crs.horizontal_code = CodeOf(horizontal.get());
      const ProjObject inner = WithoutBinding(context, horizontal.get());
      type = inner ? proj_get_type(inner.get()) : type;
    }
  } else {
    crs.states_heights = AxisCount(context, plain.get()) > 2;
    crs.horizontal_code = code;
  }
  crs.geographic = IsGeographic(type);
  AreaOfUse area;
  const char* name = nullptr;
  if (proj_get_area_of_use(context, plain.get(), &area.west_deg, &area.south_deg, &area.east_deg,
                           &area.north_deg, &name) &&
      area.south_deg >= -90.0) {
    area.name = name ? name : "";
    crs.area = area;
  }
  return crs;
}

}  // namespace pleinair::content
