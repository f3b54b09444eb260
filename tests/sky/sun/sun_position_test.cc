#include "sky/sun/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include "sky/sun/delta_t.h"
#include "sky/sun/refraction.h"

namespace pleinair::sky {
namespace {

UtcTime At(const char* text) { return UtcTime::Parse(text).value(); }

Observer Place(double latitude_deg, double longitude_deg, double height_m = 0.0) {
  return {.latitude = FromDegrees(latitude_deg),
          .longitude = FromDegrees(longitude_deg),
          .height = Metres(height_m)};
}

class PreciseSun : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!HasPreciseSun()) GTEST_SKIP() << "built without ERFA";
  }
};

// Reda & Andreas 2004, "Solar Position Algorithm for Solar Radiation Applications",
// NREL/TP-560-34302, Table A5.1.
TEST_F(PreciseSun, GivesNrelsWorkedExampleToAThousandthOfADegree) {
  Observer observer = Place(39.742476, -105.1786, 1830.14);
  observer.pressure_mbar = 820.0;
  observer.temperature_c = 11.0;
  const SunPosition sun = ComputeSunPosition(observer, At("2003-10-17T12:30:30-07:00"));
  EXPECT_NEAR(90.0 - ToDegrees(sun.elevation_refracted), 50.11162, 0.001);
  EXPECT_NEAR(ToDegrees(sun.azimuth), 194.34024, 0.001);
  EXPECT_NEAR(sun.distance_au, 0.9965422974, 5e-5);  // Their distance is from the Earth's centre.
}

// From the bundled recordings' descriptions: apparent, airless positions by astronomy-engine.
TEST_F(PreciseSun, AgreesWithAnotherAstronomyLibrary) {
  const Observer prague = Place(50.0875, 14.4213, 220.0);
  struct Reference {
    const char* time;
    double azimuth_deg, elevation_deg;
  };
  for (const Reference& reference :
       {Reference{"2025-09-14T06:45:00Z", 109.0804310814812, 19.423383679611362},
        Reference{"2025-09-14T11:05:00Z", 182.45902256588982, 43.10138338779995},
        Reference{"2025-09-14T15:20:00Z", 252.7885316417067, 17.88445927643258}}) {
    const SunPosition sun = ComputeSunPosition(prague, At(reference.time));
    EXPECT_NEAR(ToDegrees(sun.azimuth), reference.azimuth_deg, 5e-4) << reference.time;
    EXPECT_NEAR(ToDegrees(sun.elevation), reference.elevation_deg, 5e-4) << reference.time;
  }
}

struct ReferencePosition {
  const char* time;
  double latitude_deg, longitude_deg, height_m;
  double azimuth_deg, elevation_deg;
};

// Positions by another library and ephemeris (astronomy-engine 2.1.19: truncated VSOP87, apparent,
// airless, topocentric) at random places and times. Some are at the poles, the equator, a tropic
// and a polar circle.
constexpr ReferencePosition kReferencePositions[] = {
    {"2045-07-03T17:29:47Z", 90, 55.8555, 1219, 317.19612, 22.87399},
    {"2051-08-23T02:23:20Z", -90, 178.5172, 2718, 326.34666, -11.48561},
    {"2056-10-18T13:36:18Z", 89.999, -117.8287, 3533, 90.00050, -10.00810},
    {"2000-12-31T03:10:08Z", -89.999, 117.9124, 2958, 15.30530, 23.07885},
    {"2037-07-24T01:50:15Z", 0, 105.8026, 769, 64.23309, 38.76507},
    {"2068-12-03T06:06:35Z", 23.4, -95.8457, 836, 307.22394, -88.04049},
    {"1966-10-24T13:08:08Z", -66.56, 133.6703, 3376, 205.17291, -9.54139},
    {"1992-03-05T21:43:56Z", -3.3953, 83.2799, 1464, 100.95381, -42.75694},
    {"2013-04-23T12:31:41Z", -15.2772, 150.7408, 3483, 265.35244, -69.55964},
    {"1973-11-27T04:24:22Z", -8.2035, 115.095, 691, 197.39325, 76.45503},
    {"2096-12-01T11:29:12Z", -21.362, -44.2876, 2018, 100.34644, 44.38252},
    {"2015-11-03T05:44:56Z", -3.7229, 91.2626, 901, 187.91089, 78.64965},
    {"2030-11-27T07:15:31Z", 48.3203, 114.8172, 1231, 223.50027, 8.92049},
    {"2038-12-23T03:47:41Z", 43.8795, 72.0797, 444, 134.13970, 8.22804},
    {"2055-08-25T16:06:58Z", -54.6616, 68.7391, 1598, 241.52859, -31.00533},
    {"2013-02-23T01:46:50Z", -29.4535, -42.3825, 1602, 207.89276, -46.66286},
    {"1988-01-12T20:02:45Z", 62.6479, -25.0096, 91, 262.78194, -20.79719},
    {"1993-03-23T20:18:42Z", -47.239, 60.0723, 22, 175.65163, -43.95897},
    {"2071-04-19T21:55:28Z", -26.0309, -29.5934, 872, 267.74809, -31.40242},
    {"2042-08-11T11:15:41Z", -2.3642, 13.7669, 3392, 355.57805, 72.43766},
    {"2017-10-01T16:39:03Z", 23.5018, -172.5098, 2216, 89.13107, -10.66264},
    {"2023-09-11T08:58:23Z", 1.2452, 58.9183, 1167, 283.47770, 75.30881},
    {"2086-11-05T03:27:49Z", 65.2915, -107.4456, 2077, 299.87808, -29.88565},
    {"2047-12-27T09:50:28Z", 12.6568, -174.8933, 2559, 243.90314, -61.82343},
    {"1992-09-07T06:01:20Z", -11.6526, 109.6831, 2742, 309.73728, 63.03692},
    {"1978-09-26T06:43:37Z", 35.8356, 178.3463, 1971, 275.79860, -9.86952},
    {"2036-05-29T02:25:53Z", 7.9271, 62.281, 3450, 69.37208, 11.59430},
    {"1963-03-17T09:53:25Z", 22.7108, -148.9579, 3737, 352.39975, -68.67692},
};

TEST_F(PreciseSun, IsRightToAThousandthOfADegreeFrom1950To2100AtEveryLatitude) {
  for (const ReferencePosition& row : kReferencePositions) {
    const SunPosition sun =
        ComputeSunPosition(Place(row.latitude_deg, row.longitude_deg, row.height_m), At(row.time));
    const double e = FromDegrees(row.elevation_deg).value();
    const double a = FromDegrees(row.azimuth_deg).value();
    const Vec3 reference{std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)};
    SunPosition airless = sun;
    airless.elevation_refracted = sun.elevation;
    EXPECT_LT(Norm(airless.ToSun().xyz - reference) / kRadiansPerDegree, 0.001)
        << row.time << " " << row.latitude_deg << "," << row.longitude_deg;
  }
}

// Meeus 1998, "Astronomical Algorithms", Example 25.b (VSOP87): 1992 October 13, 0h TD, apparent
// declination −7°47′01.74″, distance 0.99760775 au.
TEST_F(PreciseSun, StandsAtThePoleAsHighAsItsDeclination) {
  const SunPosition sun = ComputeSunPosition(Place(90.0, 0.0), At("1992-10-12T23:59:00.816Z"));
  const double declination_deg = -(7.0 + 47.0 / 60.0 + 1.74 / 3600.0);
  const double parallax_deg =
      8.794 / 3600.0 / 0.99760775 * (6356.75 / 6378.14) * std::cos(FromDegrees(7.78).value());
  EXPECT_NEAR(ToDegrees(sun.elevation), declination_deg - parallax_deg, 3e-4);
  EXPECT_NEAR(sun.distance_au, 0.99760775, 1e-5);
}

// USNO, "Earth's seasons": perihelion 2020 January 5, 07:48 UT, 0.9832436 au; aphelion 2020 July 4,
// 11:35 UT, 1.0166943 au.
TEST_F(PreciseSun, HasTheAlmanacsDistances) {
  constexpr double kEarthRadiusAu = 4.3e-5;
  EXPECT_NEAR(ComputeSunPosition(Place(0, 0), At("2020-01-05T07:48:00Z")).distance_au, 0.9832436,
              kEarthRadiusAu);
  EXPECT_NEAR(ComputeSunPosition(Place(0, 0), At("2020-07-04T11:35:00Z")).distance_au, 1.0166943,
              kEarthRadiusAu);
}

// USNO: March equinox 2024-03-20 03:06 UTC, September equinox 2050-09-22 19:28 UTC.
TEST_F(PreciseSun, CrossesTheEquatorAtTheEquinoxes) {
  for (const char* time : {"2024-03-20T03:06:00Z", "2050-09-22T19:28:00Z"}) {
    const SunPosition sun = ComputeSunPosition(Place(90.0, 0.0), At(time));
    // 1′ of declination per hour: 0.0003° per minute; parallax lowers the sun by 0.0024°.
    EXPECT_NEAR(ToDegrees(sun.elevation), -0.0024, 0.0008) << time;
  }
}

TEST_F(PreciseSun, LosesAltitudeToParallaxAndGainsItWithHeight) {
  // The suns of a mountaineer and a diver differ by the angle that the height subtends.
  const UtcTime time = At("2025-03-20T06:00:00Z");
  const double low = ToDegrees(ComputeSunPosition(Place(0, 0, 0), time).elevation);
  const double high = ToDegrees(ComputeSunPosition(Place(0, 0, 100'000.0), time).elevation);
  const double expected_deg = -100'000.0 / 149'597'870'700.0 / kRadiansPerDegree;
  EXPECT_NEAR(high - low, expected_deg, 1e-6);
}

TEST_F(PreciseSun, MovesWithoutJumpsOverTheEdgesOfYears) {
  // Leap seconds, ends of tables and forecasts. 2 s of solar motion are 30″ on the sky and 60″ in
  // azimuth here; a much larger change is a jump. The maximum is the leap second itself, 15″, which
  // POSIX time skips.
  const Observer place = Place(48.0, 11.0);
  for (const char* edge :
       {"1950-01-01T00:00:00Z", "1960-01-01T00:00:00Z", "1972-01-01T00:00:00Z",
        "1972-07-01T00:00:00Z", "1999-01-01T00:00:00Z", "2000-01-01T00:00:00Z",
        "2017-01-01T00:00:00Z", "2025-01-01T00:00:00Z", "2050-01-01T00:00:00Z",
        "2100-01-01T00:00:00Z", "1970-01-01T00:00:00Z", "2024-02-29T00:00:00Z"}) {
    const SunPosition before = ComputeSunPosition(place, At(edge).PlusSeconds(-1.0));
    const SunPosition after = ComputeSunPosition(place, At(edge).PlusSeconds(1.0));
    EXPECT_NEAR(ToDegrees(after.elevation - before.elevation), 0.0, 40.0 / 3600.0) << edge;
    EXPECT_NEAR(ToDegrees(after.azimuth - before.azimuth), 0.0, 80.0 / 3600.0) << edge;
  }
}

TEST_F(PreciseSun, TurnsByDut1AsTheEarthDoes) {
  Observer observer = Place(0.0, 0.0);
  const UtcTime time = At("2025-03-20T12:00:00Z");
  const double without = ToDegrees(ComputeSunPosition(observer, time).elevation);
  observer.ut1_minus_utc_s = 0.5;
  const double with = ToDegrees(ComputeSunPosition(observer, time).elevation);
  EXPECT_NEAR(std::fabs(with - without), 0.5 * 15.04 / 3600.0, 1e-4);
}

TEST_F(PreciseSun, IsTheSameFromManyThreads) {
  constexpr int kPositions = 400;
  const auto compute = [](int i) {
    return ComputeSunPosition(Place(i % 180 - 90.0, i * 0.9 - 180.0, i),
                              UtcTime(i * 10'000'000'000'000'000LL))
        .azimuth;
  };
  std::vector<Radians> serial, parallel(kPositions);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = t; i < kPositions; i += 4) parallel[i] = compute(i);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < kPositions; ++i) serial.push_back(compute(i));
  EXPECT_EQ(serial, parallel);
}

TEST(SunPosition, IsFiniteAndInRangeEverywhere) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> longitude(-180.0, 360.0);
  std::uniform_int_distribution<std::int64_t> time(INT64_MIN, INT64_MAX);
  for (int i = 0; i < 2000; ++i) {
    const double latitude = i % 4 == 0 ? 90.0 : i % 4 == 1 ? -90.0 : i * 0.09 - 90.0;
    for (const SunModel model : {SunModel::kPrecise, SunModel::kPaper}) {
      const SunPosition sun =
          ComputeSunPosition(Place(latitude, longitude(random)), UtcTime(time(random)), model);
      ASSERT_TRUE(std::isfinite(sun.azimuth.value()) && std::isfinite(sun.elevation.value()));
      ASSERT_GE(sun.azimuth.value(), 0.0);
      ASSERT_LT(sun.azimuth.value(), 2.0 * M_PI);
      ASSERT_LE(std::fabs(ToDegrees(sun.elevation)), 90.0);
      ASSERT_NEAR(sun.distance_au, 1.0, 0.018);
      ASSERT_NEAR(Norm(sun.ToSun().xyz), 1.0, 1e-12);
    }
  }
}

TEST(SunPosition, PointsEastInTheMorningAndSouthAtNoon) {
  const Observer place = Place(50.0, 0.0);
  EXPECT_GT(ComputeSunPosition(place, At("2025-03-20T06:30:00Z")).ToSun().xyz.x, 0.95);
  EXPECT_LT(ComputeSunPosition(place, At("2025-03-20T12:07:00Z")).ToSun().xyz.y, -0.7);
}

TEST(SunPosition, HasADiscOfHalfADegree) {
  SunPosition sun;
  EXPECT_NEAR(ToDegrees(sun.AngularRadius()), 0.26656, 1e-5);
}

// Meeus 1998, chapter 16: 28.98′ at the horizon of the formula's own scale (his Eq. 16.4 at h = 0).
TEST(Refraction, IsSaemundssons) {
  EXPECT_NEAR(ToDegrees(Refraction(Radians(0.0), 1010.0, 10.0)) * 60.0, 28.98, 0.01);
  // Smart's mean refraction at 45°: 0.97′.
  EXPECT_NEAR(ToDegrees(Refraction(FromDegrees(45.0), 1010.0, 10.0)) * 60.0, 1.01, 0.02);
  EXPECT_NEAR(Refraction(FromDegrees(10.0), 505.0, 10.0).value(),
              0.5 * Refraction(FromDegrees(10.0), 1010.0, 10.0).value(), 1e-15);
  EXPECT_NEAR(Refraction(FromDegrees(10.0), 1010.0, 293.0).value(),
              0.5 * Refraction(FromDegrees(10.0), 1010.0, 10.0).value(), 1e-15);
}

TEST(Refraction, IsContinuousAndKeepsTheOrderOfElevations) {
  double last = -91.0;
  for (double e = -90.0; e <= 90.0; e += 0.01) {
    const double refraction = ToDegrees(Refraction(FromDegrees(e), 1010.0, 10.0));
    EXPECT_GE(refraction, 0.0);
    EXPECT_GT(e + refraction, last) << e;
    EXPECT_LT(e + refraction - last, e < -89.99 ? 2.0 : 0.02) << e;
    last = e + refraction;
  }
  EXPECT_EQ(Refraction(FromDegrees(-3.0), 1010.0, 10.0).value(), 0.0);
}

// Espenak & Meeus 2006, Table 2.
TEST(DeltaT, FollowsThePublishedTable) {
  struct Row {
    double year, seconds;
  };
  for (const Row& row : {Row{1700, 9},
                         {1750, 13},
                         {1800, 14},
                         {1850, 7},
                         {1900, -3},
                         {1950, 29},
                         {1955, 31.1},
                         {1960, 33.2},
                         {1965, 35.7},
                         {1970, 40.2},
                         {1975, 45.5},
                         {1980, 50.5},
                         {1985, 54.3},
                         {1990, 56.9},
                         {1995, 60.8},
                         {2000, 63.8},
                         {2005, 64.7}}) {
    EXPECT_NEAR(DeltaTSeconds(row.year), row.seconds, 1.0) << row.year;
  }
  EXPECT_NEAR(DeltaTSeconds(2050), 93.0, 1.0);
  EXPECT_NEAR(DeltaTSeconds(2100), 203.0, 1.0);
}

TEST(DeltaT, JoinsItsPolynomials) {
  for (const double year :
       {1700.0, 1800.0, 1860.0, 1900.0, 1920.0, 1941.0, 1961.0, 1986.0, 2005.0, 2050.0, 2150.0}) {
    EXPECT_NEAR(DeltaTSeconds(year - 1e-9), DeltaTSeconds(year), 0.8) << year;
  }
}

}  // namespace
}  // namespace pleinair::sky
