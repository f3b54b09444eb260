#include "content/georeference/map_transform.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace pleinair::content {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double Dms(double degrees, double minutes, double seconds) {
  return degrees + minutes / 60.0 + seconds / 3600.0;
}

constexpr Place kPrague{50.0875, 14.4213, 220.0, HeightReference::kEllipsoid};

MapTransform Transform(const std::string& crs, const Place& place) {
  auto transform = MapTransform::Create(crs, place, "file");
  if (!transform) {
    ADD_FAILURE() << transform.error().Message();
    return *MapTransform::Create("EPSG:4326", place, "file");
  }
  return *std::move(transform);
}

Vec3 EastNorthUp(const MapTransform& transform, const MapPoint& point) {
  const auto enu = transform.EastNorthUp(point);
  EXPECT_TRUE(enu);
  return enu ? enu->xyz : Vec3{};
}

/// One point in a projected CRS, published with its geographic coordinates of the same datum.
struct PublishedPoint {
  const char* source;
  const char* projected;
  const char* geographic;
  MapPoint grid;
  double latitude_deg, longitude_deg;
  double tolerance_m;  ///< That of the last published digits.
};

const std::array kPublished = {
    PublishedPoint{"IOGP Guidance Note 7-2, Transverse Mercator",
                   "EPSG:27700",
                   "EPSG:4277",
                   {577274.99, 69740.50, 0.0},
                   50.5,
                   0.5,
                   0.01},
    PublishedPoint{"Ordnance Survey, A guide to coordinate systems, annex C",
                   "EPSG:27700",
                   "EPSG:4277",
                   {651409.903, 313177.270, 0.0},
                   Dms(52, 39, 27.2531),
                   Dms(1, 43, 4.5177),
                   0.002},
    PublishedPoint{"IOGP Guidance Note 7-2, Lambert Conic Conformal (2SP), US survey feet",
                   "EPSG:32040",
                   "EPSG:4267",
                   {2963503.91, 254759.80, 0.0},
                   28.5,
                   -96.0,
                   0.0025},
    // The note rounds to 1 cm; the digits are those of GeoAPI's conformance tests.
    PublishedPoint{"IOGP Guidance Note 7-2, Krovak",
                   "EPSG:5514",
                   "EPSG:4156",
                   {-568990.997, -1050538.643, 0.0},
                   Dms(50, 12, 32.442),
                   Dms(16, 50, 59.179),
                   0.02},
};

// Both ways to the marker pass the same change of datum, so that what remains is the projection.
TEST(MapTransform, GivesPublishedExamplesOfProjections) {
  for (const PublishedPoint& point : kPublished) {
    SCOPED_TRACE(point.source);
    const Place place{point.latitude_deg, point.longitude_deg, 0.0, HeightReference::kEllipsoid};
    const Vec3 from_grid = EastNorthUp(Transform(point.projected, place), point.grid);
    const Vec3 from_degrees = EastNorthUp(Transform(point.geographic, place),
                                          {point.longitude_deg, point.latitude_deg, 0.0});
    EXPECT_NEAR(from_grid.x, from_degrees.x, point.tolerance_m);
    EXPECT_NEAR(from_grid.y, from_degrees.y, point.tolerance_m);
    EXPECT_NEAR(from_grid.z, from_degrees.z, 1e-3);
  }
}

// IOGP Guidance Note 7-2, Geocentric translations: a point in WGS 84 (73 m) and in ED50 (28.02 m).
TEST(MapTransform, ShiftsTheDatumAsInThePublishedExample) {
  const Place place{Dms(53, 48, 33.82), Dms(2, 7, 46.38), 73.0, HeightReference::kEllipsoid};
  const MapTransform transform =
      Transform("+proj=longlat +ellps=intl +towgs84=-84.87,-96.49,-116.95 +no_defs", place);
  const Vec3 enu = EastNorthUp(transform, {Dms(2, 7, 51.477), Dms(53, 48, 36.565), 28.02});
  // The published seconds have three digits, 3 cm.
  EXPECT_NEAR(enu.x, 0.0, 0.03);
  EXPECT_NEAR(enu.y, 0.0, 0.03);
  EXPECT_FALSE(transform.facts().datum_unknown);
}

/// Largest distance, over directions, of a transform of UTM from independent formulae.
double LargestError_m(const Place& place, double distance_m, const std::string& crs, int zone) {
  const MapTransform transform = Transform(crs, place);
  const GeographicLib::LocalCartesian frame(place.latitude_deg, place.longitude_deg,
                                            place.height_m);
  double largest = 0.0;
  for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 15) {
    double latitude = 0.0, longitude = 0.0;
    GeographicLib::Geodesic::WGS84().Direct(place.latitude_deg, place.longitude_deg, azimuth_deg,
                                            distance_m, latitude, longitude);
    const double height_m = place.height_m + azimuth_deg;
    Vec3 expected;
    frame.Forward(latitude, longitude, height_m, expected.x, expected.y, expected.z);
    int used_zone = 0;
    bool north = true;
    MapPoint grid{0.0, 0.0, height_m};
    GeographicLib::UTMUPS::Forward(latitude, longitude, used_zone, north, grid.x, grid.y, zone);
    largest = std::max(largest, Norm(EastNorthUp(transform, grid) - expected));
  }
  return largest;
}

TEST(MapTransform, IsExactToMillimetresFarAway) {
  const Place tromso{69.65, 18.96, 30.0, HeightReference::kEllipsoid};
  const Place sydney{-33.87, 151.21, 20.0, HeightReference::kEllipsoid};
  const Place zone_edge{46.0, 11.99, 300.0, HeightReference::kEllipsoid};
  for (const double distance_m : {1.0, 100.0, 2000.0, 50000.0}) {
    EXPECT_LT(LargestError_m(kPrague, distance_m, "EPSG:32633", 33), 1e-4);
    EXPECT_LT(LargestError_m(tromso, distance_m, "EPSG:32633", 33), 1e-4);
    EXPECT_LT(LargestError_m(sydney, distance_m, "EPSG:32756", 56), 1e-4);
    EXPECT_LT(LargestError_m(zone_edge, distance_m, "EPSG:32632", 32), 1e-4);
  }
}

// The shortcut (grid differences as east and north) would be off by 15.5 m at 2 km.
TEST(MapTransform, IncludesConvergenceAndScaleOfTheGrid) {
  const MapTransform transform = Transform("EPSG:32633", kPrague);
  const MapPoint marker{458594.0, 5548542.0, 220.0};
  const MapPoint north{marker.x, marker.y + 2000.0, 220.0};
  const Vec3 way = EastNorthUp(transform, north) - EastNorthUp(transform, marker);
  EXPECT_NEAR(std::atan2(way.x, way.y) * 180.0 / std::acos(-1.0), -0.444, 0.001);
  EXPECT_NEAR(std::hypot(way.x, way.y), 2000.0 / 0.9996, 0.2);
}

TEST(MapTransform, TakesLongitudeFirstWhateverTheAuthorityOrders) {
  for (const char* crs : {"EPSG:4326", "OGC:CRS84", "+proj=longlat +datum=WGS84"}) {
    const Vec3 enu = EastNorthUp(Transform(crs, kPrague), {14.4223, 50.0875, 220.0});
    EXPECT_NEAR(enu.x, 71.6, 0.1) << crs;
    EXPECT_NEAR(enu.y, 0.0, 0.01) << crs;
    EXPECT_NEAR(enu.z, 0.0, 0.01) << crs;
  }
}

TEST(MapTransform, SharesTheHeightReferenceWhereTheCrsStatesNone) {
  const Place sea{50.0875, 14.4213, 220.0, HeightReference::kSeaLevel};
  const MapTransform transform = Transform("EPSG:4326", sea);
  EXPECT_EQ(transform.facts().heights, HeightDatum::kShared);
  EXPECT_FALSE(transform.facts().undulation_m);
  EXPECT_NEAR(EastNorthUp(transform, {14.4213, 50.0875, 223.5}).z, 3.5, 1e-6);
}

// NGA, "OUTINTPT.DAT" of the EGM96 program INTPT: its sample output, interpolated from the grid
// WW15MGH.GRD. PROJ interpolates the same grid bilinearly.
TEST(MapTransform, ReducesTheHeightOfThePlaceByThePublishedGeoid) {
  struct Undulation {
    double latitude_deg, longitude_deg, height_m;
  };
  constexpr std::array<Undulation, 5> kNga = {{{38.6281550, 269.7791550 - 360.0, -31.628},
                                               {-14.6212170, 305.0211140 - 360.0, -2.969},
                                               {46.8743190, 102.4487290, -43.575},
                                               {-23.6174460, 133.8747120, 15.871},
                                               {38.6254730, 359.9995000 - 360.0, 50.066}}};
  for (const Undulation& nga : kNga) {
    const Place sea{nga.latitude_deg, nga.longitude_deg, 100.0, HeightReference::kSeaLevel};
    const MapTransform ellipsoidal = Transform("EPSG:4979", sea);
    ASSERT_TRUE(ellipsoidal.facts().undulation_m);
    EXPECT_NEAR(*ellipsoidal.facts().undulation_m, nga.height_m, 0.15);
    EXPECT_EQ(ellipsoidal.facts().heights, HeightDatum::kTransformed);
    EXPECT_NEAR(
        EastNorthUp(ellipsoidal, {nga.longitude_deg, nga.latitude_deg, 100.0 + nga.height_m}).z,
        0.0, 0.15);
    // Both above the sea: the geoid cancels.
    EXPECT_NEAR(
        EastNorthUp(Transform("EPSG:4326+5773", sea), {nga.longitude_deg, nga.latitude_deg, 100.0})
            .z,
        0.0, 1e-6);
  }
}

TEST(MapTransform, NamesTheGridThatIsMissingForHeights) {
  const Place london{51.5, -0.12, 20.0, HeightReference::kEllipsoid};
  const auto transform = MapTransform::Create("EPSG:27700+5701", london, "plan.gpkg");
  ASSERT_FALSE(transform) << "the grid is installed here";
  EXPECT_THAT(
      transform.error().Message(),
      AllOf(HasSubstr("plan.gpkg: the grid uk_os_OSGM15_GB.tif for \"ODN height\""),
            HasSubstr("projsync --file uk_os_OSGM15_GB.tif"), HasSubstr("--crs EPSG:27700")));
}

TEST(MapTransform, ReportsAMoreAccurateOperationWhoseGridIsMissing) {
  const Place london{51.5, -0.12, 20.0, HeightReference::kEllipsoid};
  const MapTransform transform = Transform("EPSG:27700", london);
  EXPECT_THAT(transform.facts().missing_grids, testing::Contains(HasSubstr("OSTN15")));
  EXPECT_EQ(transform.facts().accuracy_m, 2.0);
}

TEST(MapTransform, RefusesHeightsThatProjCannotRelate) {
  const auto transform = MapTransform::Create("EPSG:32633+8357", kPrague, "plan.gpkg");
  ASSERT_FALSE(transform);
  EXPECT_THAT(transform.error().Message(),
              AllOf(HasSubstr("Baltic 1957 height"), HasSubstr("no transformation"),
                    HasSubstr("--crs EPSG:32633")));
}

TEST(MapTransform, ReportsADatumThatIsNotKnown) {
  const MapTransform transform = Transform("+proj=utm +zone=33 +ellps=bessel", kPrague);
  EXPECT_TRUE(transform.facts().datum_unknown);
  EXPECT_FALSE(Transform("EPSG:32633", kPrague).facts().datum_unknown);
}

TEST(MapTransform, ReportsTheAreaOfUse) {
  const Place bratislava_zone_off{48.15, 25.0, 150.0, HeightReference::kEllipsoid};
  EXPECT_TRUE(Transform("EPSG:32633", bratislava_zone_off).facts().place_outside_area);
  const MapTransform inside = Transform("EPSG:32633", kPrague);
  EXPECT_FALSE(inside.facts().place_outside_area);
  EXPECT_TRUE(inside.InArea({14.0, 50.0, 0.0}));
  EXPECT_FALSE(inside.InArea({19.0, 50.0, 0.0}));
  // Fiji's grid crosses the 180th meridian.
  const MapTransform fiji =
      Transform("EPSG:3460", {-17.8, 178.5, 0.0, HeightReference::kEllipsoid});
  EXPECT_TRUE(fiji.InArea({-179.0, -18.0, 0.0}));
  EXPECT_FALSE(fiji.InArea({0.0, -18.0, 0.0}));
}

TEST(MapTransform, RefusesWhatIsNoCrs) {
  for (const char* crs : {"EPSG:999999", "", "nonsense", "+proj=nothing", "EPSG:5773",
                          "+proj=pipeline +step +proj=cart", "/etc/passwd"}) {
    const auto transform = MapTransform::Create(crs, kPrague, "--crs");
    ASSERT_FALSE(transform) << crs;
    EXPECT_THAT(transform.error().Message(), testing::StartsWith("--crs: ")) << crs;
  }
}

TEST(MapTransform, HasNoPositionForCoordinatesThatAreNoNumbers) {
  const MapTransform transform = Transform("EPSG:32633", kPrague);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -infinite, 1e300, -1e300}) {
    EXPECT_FALSE(transform.EastNorthUp({bad, 5548500.0, 0.0}));
    EXPECT_FALSE(transform.EastNorthUp({458600.0, bad, 0.0}));
    EXPECT_FALSE(transform.EastNorthUp({458600.0, 5548500.0, bad}));
  }
  EXPECT_FALSE(Transform("EPSG:4326", kPrague).EastNorthUp({14.0, 91.0, 0.0}));
  EXPECT_TRUE(transform.EastNorthUp({458600.0, 5548500.0, 0.0}));
}

}  // namespace
}  // namespace pleinair::content
