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

GeodeticPoint GeodeticFromGeocentric(const Vec3& point_m) {
  // A step shrinks the error by e² h / (a + h): by 0.001 for 1,000 km, by 10⁻⁶ near the ground.
  constexpr int kMaxSteps = 7;
  constexpr double kRounding_rad = 2e-16;
  const double from_axis_m = std::hypot(point_m.x, point_m.y);
  double latitude = std::atan2(point_m.z, from_axis_m * (1.0 - kSquaredEccentricity));
  double height_m = 0.0;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double before = latitude;
    const double sine = std::sin(latitude), cosine = std::cos(latitude);
    const double nu = kSemiMajorAxis_m / std::sqrt(1.0 - kSquaredEccentricity * sine * sine);
    latitude = std::atan2(point_m.z + kSquaredEccentricity * nu * sine, from_axis_m);
    // Along the normal, which has no weak direction.
    height_m = from_axis_m * cosine + point_m.z * sine -
               kSemiMajorAxis_m * std::sqrt(1.0 - kSquaredEccentricity * sine * sine);
    if (std::fabs(latitude - before) <= kRounding_rad) break;
  }
  return {ToDegrees(Radians(std::atan2(point_m.y, point_m.x))), ToDegrees(Radians(latitude)),
          height_m};
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

GeodeticPoint LocalFrame::Geodetic(const Point<World>& point) const {
  return GeodeticFromGeocentric(geocentric_origin_m_ +
                                world_from_geocentric_.Transposed() * point.xyz);
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
