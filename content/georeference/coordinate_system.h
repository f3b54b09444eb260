#pragma once

// Internal: coordinate reference systems as PROJ knows them.

#include <optional>
#include <string>

#include "base/error.h"
#include "content/georeference/local_frame.h"
#include "content/georeference/proj_handles.h"

namespace pleinair::content {

/// Bounds in degrees; west > east if they cross the 180th meridian.
struct AreaOfUse {
  std::string name;
  double west_deg = 0.0, south_deg = 0.0, east_deg = 0.0, north_deg = 0.0;

  bool Contains(const GeodeticPoint& point) const;
};

/// A coordinate reference system (CRS).
struct CoordinateSystem {
  ProjObject object;
  std::string name;  ///< For people: "WGS 84 / UTM zone 33N (EPSG:32633)".
  bool geographic = false;
  /// True if the CRS defines what its heights are measured from: compound, three-dimensional and
  /// geocentric ones do.
  bool states_heights = false;
  std::string vertical_name;      ///< The vertical part's of a compound CRS; else empty.
  std::string horizontal_code;    ///< Its horizontal part's, as "EPSG:32633"; empty: it has none.
  std::optional<AreaOfUse> area;  ///< Unset: not stated.
};

/// Parses a CRS: a code ("EPSG:32633", "EPSG:5514+5773"), WKT, PROJJSON, a PROJ string or a name.
/// `where` names the file or option in errors. Errors (input): PROJ does not know it, or it defines
/// no CRS of the Earth.
Result<CoordinateSystem> ParseCoordinateSystem(PJ_CONTEXT* context, const std::string& text,
                                               const std::string& where);

}  // namespace pleinair::content
