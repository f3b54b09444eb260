#include "content/georeference/local_frame.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

namespace pleinair::content {
namespace {

constexpr double Dms(double degrees, double minutes, double seconds) {
  return degrees + minutes / 60.0 + seconds / 3600.0;
}

// IOGP Guidance Note 7-2, section 4.1.1: a point in the North Sea, WGS 84.
const GeodeticPoint kNorthSea{Dms(2, 7, 46.38), Dms(53, 48, 33.82), 73.0};

TEST(LocalFrame, GivesTheGeocentricExampleOfIogp) {
  const Vec3 xyz = GeocentricFromGeodetic(kNorthSea);
  EXPECT_NEAR(xyz.x, 3771793.968, 6e-4);
  EXPECT_NEAR(xyz.y, 140253.342, 6e-4);
  EXPECT_NEAR(xyz.z, 5124304.349, 6e-4);
}

// Section 4.1.2, method 9837: the same point from 55 N, 5 E, 200 m.
TEST(LocalFrame, GivesTheTopocentricExampleOfIogp) {
  const LocalFrame frame(GeodeticPoint{5.0, 55.0, 200.0});
  const Vec3 enu = frame.EastNorthUp(kNorthSea).xyz;
  EXPECT_NEAR(enu.x, -189013.869, 6e-4);
  EXPECT_NEAR(enu.y, -128642.040, 6e-4);
  EXPECT_NEAR(enu.z, -4220.171, 6e-4);
}

TEST(LocalFrame, AgreesWithGeographicLibEverywhere) {
  for (int latitude = -90; latitude <= 90; latitude += 15) {
    for (int longitude = -180; longitude <= 180; longitude += 45) {
      const LocalFrame frame(
          GeodeticPoint{static_cast<double>(longitude), static_cast<double>(latitude), 431.0});
      const GeographicLib::LocalCartesian other(latitude, longitude, 431.0);
      for (const double offset_deg : {0.0, 0.001, 0.02, 1.0, 60.0}) {
        const GeodeticPoint point{longitude + offset_deg, latitude * 0.7 + offset_deg * 0.3, 12.5};
        const Vec3 enu = frame.EastNorthUp(point).xyz;
        double east = 0.0, north = 0.0, up = 0.0;
        other.Forward(point.latitude_deg, point.longitude_deg, point.height_m, east, north, up);
        EXPECT_NEAR(enu.x, east, 1e-7);
        EXPECT_NEAR(enu.y, north, 1e-7);
        EXPECT_NEAR(enu.z, up, 1e-7);
      }
    }
  }
}

// The ellipsoid lies d² / 2R below the tangent plane.
TEST(LocalFrame, ContainsTheCurvatureOfTheEarth) {
  const LocalFrame frame(GeodeticPoint{14.4213, 50.0875, 0.0});
  for (const double distance_m : {2000.0, 10000.0}) {
    double latitude = 0.0, longitude = 0.0;
    GeographicLib::Geodesic::WGS84().Direct(50.0875, 14.4213, 90.0, distance_m, latitude,
                                            longitude);
    const Vec3 enu = frame.EastNorthUp({longitude, latitude, 0.0}).xyz;
    EXPECT_NEAR(enu.z, -distance_m * distance_m / (2.0 * 6390702.0), 0.01);
    EXPECT_NEAR(enu.x, distance_m, 0.005);
  }
}

TEST(LocalFrame, MeasuresTheShortestWay) {
  const GeodesicWay way = ShortestWay({14.4213, 50.0875, 0.0}, {-73.98, 40.75, 0.0});
  double distance_m = 0.0, azimuth_deg = 0.0, end_deg = 0.0;
  GeographicLib::Geodesic::WGS84().Inverse(50.0875, 14.4213, 40.75, -73.98, distance_m, azimuth_deg,
                                           end_deg);
  EXPECT_NEAR(way.distance_m, distance_m, 1e-6);
  EXPECT_NEAR(way.azimuth_deg, azimuth_deg + 360.0, 1e-9);
}

TEST(LocalFrame, GoesBackToGeodeticPlacesAsGeographicLib) {
  for (const double latitude_deg : {-90.0, -89.9999, -45.0, 0.0, 0.001, 50.0875, 89.0, 90.0}) {
    for (const double height_m : {-5000.0, 0.0, 8848.0, 100000.0}) {
      const GeodeticPoint place{14.4213, latitude_deg, height_m};
      const GeodeticPoint back = GeodeticFromGeocentric(GeocentricFromGeodetic(place));
      EXPECT_NEAR(back.latitude_deg, latitude_deg, 1e-13) << height_m;
      EXPECT_NEAR(back.height_m, height_m, 3e-9) << latitude_deg;
      const LocalFrame frame({-70.0, 30.0, 500.0});
      const GeodeticPoint through = frame.Geodetic(frame.EastNorthUp(place));
      EXPECT_NEAR(through.latitude_deg, latitude_deg, 1e-13);
      EXPECT_NEAR(through.height_m, height_m, 1e-8);
    }
  }
  const GeographicLib::LocalCartesian independent(50.0875, 14.4213, 220.0);
  const LocalFrame frame({14.4213, 50.0875, 220.0});
  for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{2000, -1500, 80}, Vec3{-50000, 30000, -200}}) {
    double latitude_deg = 0.0, longitude_deg = 0.0, height_m = 0.0;
    independent.Reverse(at.x, at.y, at.z, latitude_deg, longitude_deg, height_m);
    const GeodeticPoint found = frame.Geodetic({at});
    EXPECT_NEAR(found.latitude_deg, latitude_deg, 1e-13);
    EXPECT_NEAR(found.longitude_deg, longitude_deg, 1e-13);
    EXPECT_NEAR(found.height_m, height_m, 1e-8);
  }
}

}  // namespace
}  // namespace pleinair::content
