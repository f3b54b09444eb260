#pragma once

#include <span>
#include <string>

#include "base/error.h"
#include "content/georeference/map_transform.h"

namespace pleinair::content {

/// "north-west" for 300 degrees: the nearest of eight points of the compass.
std::string CompassPoint(double azimuth_deg);

/// "12.3 km north-west (305 degrees)".
std::string DescribeWay(const GeodesicWay& way);

/// Checks that content lies near the marker. Passes if a point lies within `radius_m` of the place,
/// along the ellipsoid. Error (input): none does; it states distance and direction of the nearest
/// point. If exchanged coordinates or other signs bring a point near, the remedy is that.
/// Points without a position in the CRS are ignored.
Result<void> CheckNear(const MapTransform& transform, std::span<const MapPoint> points,
                       double radius_m, const std::string& where);

}  // namespace pleinair::content
