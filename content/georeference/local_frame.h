#pragma once

#include "base/error.h"
#include "base/frames.h"
#include "base/vector.h"

namespace pleinair::content {

/// What a height is measured from.
enum class HeightReference {
  kSeaLevel,   ///< The geoid, as maps and levels show it.
  kEllipsoid,  ///< The ellipsoid of WGS 84, as satellite receivers measure it.
};

/// Where the marker's origin is on Earth.
struct Place {
  double latitude_deg = 0.0;   ///< WGS 84, north positive, -90…90.
  double longitude_deg = 0.0;  ///< WGS 84, east positive, -180…180.
  double height_m = 0.0;
  HeightReference reference = HeightReference::kSeaLevel;
};

/// Longitude (x) and latitude (y) in degrees, WGS 84, and a height in metres (z).
struct GeodeticPoint {
  double longitude_deg = 0.0, latitude_deg = 0.0, height_m = 0.0;
};

/// Earth-centred, earth-fixed coordinates on the ellipsoid of WGS 84, metres. IOGP Guidance Note
/// 7-2, method EPSG:9602: X = (ν + h) cos φ cos λ, Y = (ν + h) cos φ sin λ,
/// Z = ((1 − e²) ν + h) sin φ, with ν = a / √(1 − e² sin² φ).
Vec3 GeocentricFromGeodetic(const GeodeticPoint& point);

/// The reverse, by fixed-point iteration of the latitude; within 1 nm up to 1,000 km from the
/// ellipsoid.
GeodeticPoint GeodeticFromGeocentric(const Vec3& point_m);

/// The tangent frame of a place: east, north, up (World), metres. IOGP Guidance Note 7-2, method
/// EPSG:9837: the difference of geocentric coordinates, rotated by latitude and longitude of the
/// origin. Exact for every distance: it contains the curvature of the Earth and no map projection.
class LocalFrame {
 public:
  /// `origin` and the points of EastNorthUp() have heights of one reference.
  explicit LocalFrame(const GeodeticPoint& origin);

  Point<World> EastNorthUp(const GeodeticPoint& point) const;
  /// The reverse; its height has the reference of the origin's.
  GeodeticPoint Geodetic(const Point<World>& point) const;
  const GeodeticPoint& origin() const { return origin_; }

 private:
  GeodeticPoint origin_;
  Vec3 geocentric_origin_m_;
  Mat3 world_from_geocentric_;
};

/// Way along the ellipsoid, for places at any distance.
struct GeodesicWay {
  double distance_m = 0.0;
  double azimuth_deg = 0.0;  ///< At the first point, clockwise from true north, 0…360.
};

/// The shortest way between two points of the ellipsoid (Karney 2013). Heights are ignored.
GeodesicWay ShortestWay(const GeodeticPoint& from, const GeodeticPoint& to);

}  // namespace pleinair::content
