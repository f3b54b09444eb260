#include "content/georeference/local_frame.h"

#include <geodesic.h>

#include <cmath>

#include "base/units.h"

namespace pleinair::content {
namespace {

// WGS 84 (NIMA TR8350.2, table 3.1).
constexpr double kSemiMajorAxis_m = 6378137.0;
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kSquaredEccentricity = kFlattening * (2.0 - kFlattening);

}  // namespace

Vec3 GeocentricFromGeodetic(const GeodeticPoint& point) {
  const double latitude = FromDegrees(point.latitude_deg).value();
  const double longitude = FromDegrees(point.longitude_deg).value();
  const double sine = std::sin(latitude), cosine = std::cos(latitude);
  const double nu = kSemiMajorAxis_m / std::sqrt(1.0 - kSquaredEccentricity * sine * sine);
  return {(nu + point.height_m) * cosine * std::cos(longitude),
          (nu + point.height_m) * cosine * std::sin(longitude),
          ((1.0 - kSquaredEccentricity) * nu + point.height_m) * sine};
}

LocalFrame::LocalFrame(const GeodeticPoint& origin)
    : origin_(origin), geocentric_origin_m_(GeocentricFromGeodetic(origin)) {
  const double latitude = FromDegrees(origin.latitude_deg).value();
  const double longitude = FromDegrees(origin.longitude_deg).value();
  const double sp = std::sin(latitude), cp = std::cos(latitude);
  const double sl = std::sin(longitude), cl = std::cos(longitude);
  world_from_geocentric_ = {{-sl, cl, 0.0, -sp * cl, -sp * sl, cp, cp * cl, cp * sl, sp}};
}

Point<World> LocalFrame::EastNorthUp(const GeodeticPoint& point) const {
  return {world_from_geocentric_ * (GeocentricFromGeodetic(point) - geocentric_origin_m_)};
}

GeodesicWay ShortestWay(const GeodeticPoint& from, const GeodeticPoint& to) {
  geod_geodesic ellipsoid;
  geod_init(&ellipsoid, kSemiMajorAxis_m, kFlattening);
  GeodesicWay way;
  geod_inverse(&ellipsoid, from.latitude_deg, from.longitude_deg, to.latitude_deg, to.longitude_deg,
               &way.distance_m, &way.azimuth_deg, nullptr);
  if (way.azimuth_deg < 0.0) way.azimuth_deg += 360.0;
  return way;
}

}  // namespace pleinair::content
