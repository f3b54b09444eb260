#include "sky/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include "sky/delta_t.h"
#include "sky/refraction.h"

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
  EXPECT_NEAR(sun.distance_au, 0.9965422974, 5e-5);  // Theirs is from the Earth's centre.
}

// Of the bundled recordings' descriptions: astronomy-engine's apparent, airless positions.
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
    // 1′ of declination an hour: 0.0003° a minute; parallax lowers the sun by 0.0024°.
    EXPECT_NEAR(ToDegrees(sun.elevation), -0.0024, 0.0008) << time;
  }
}

TEST_F(PreciseSun, LosesAltitudeToParallaxAndGainsItWithHeight) {
  // A mountaineer's and a diver's sun differ by the angle that the height is seen under.
  const UtcTime time = At("2025-03-20T06:00:00Z");
  const double low = ToDegrees(ComputeSunPosition(Place(0, 0, 0), time).elevation);
  const double high = ToDegrees(ComputeSunPosition(Place(0, 0, 100'000.0), time).elevation);
  const double expected_deg = -100'000.0 / 149'597'870'700.0 / kRadiansPerDegree;
  EXPECT_NEAR(high - low, expected_deg, 1e-6);
}

TEST_F(PreciseSun, MovesWithoutJumpsOverTheEdgesOfYears) {
  // Leap seconds, ends of tables and forecasts: 2 s of solar motion are 30″ on the sky, 60″ in
  // azimuth here; what is much more than that is a jump. The largest is the leap second itself,
  // 15″, which POSIX time skips.
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
