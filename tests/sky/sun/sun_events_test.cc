#include "sky/sun/sun_events.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pleinair::sky {
namespace {

UtcTime At(const char* text) { return UtcTime::Parse(text).value(); }

Observer Place(double latitude_deg, double longitude_deg) {
  return {.latitude = FromDegrees(latitude_deg), .longitude = FromDegrees(longitude_deg)};
}

double SecondsBetween(UtcTime a, UtcTime b) {
  return static_cast<double>(a.nanoseconds_since_1970() - b.nanoseconds_since_1970()) * 1e-9;
}

class SunEventsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!HasPreciseSun()) GTEST_SKIP() << "built without ERFA";
  }
};

// Reda & Andreas 2004, Table A5.1: sunrise 6.212067 h, transit 11.768045 h, zone −7 h. (Their
// sunset belongs to the neighbouring UT day.)
TEST_F(SunEventsTest, GiveNrelsSunriseAndTransit) {
  const SunEvents events =
      ComputeSunEvents(Place(39.742476, -105.1786), At("2003-10-17T12:30:30-07:00"));
  const UtcTime midnight = At("2003-10-17T00:00:00-07:00");
  ASSERT_TRUE(events.sunrise && events.sunset);
  EXPECT_NEAR(SecondsBetween(*events.sunrise, midnight), 6.212067 * 3600.0, 3.0);
  EXPECT_NEAR(SecondsBetween(events.noon, midnight), 11.768045 * 3600.0, 1.0);
}

TEST_F(SunEventsTest, LieWhereTheSunIsOnTheHorizonAndOnTheMeridian) {
  for (const double latitude : {-65.0, -33.0, 0.0, 15.0, 50.0, 66.0}) {
    for (const double longitude : {-179.0, -70.0, 0.0, 14.0, 151.0}) {
      const Observer place = Place(latitude, longitude);
      const SunEvents events = ComputeSunEvents(place, At("2025-03-01T03:00:00Z"));
      ASSERT_TRUE(events.sunrise && events.sunset);
      EXPECT_LT(*events.sunrise, events.noon);
      EXPECT_LT(events.noon, *events.sunset);
      EXPECT_NEAR(ToDegrees(ComputeSunPosition(place, *events.sunrise).elevation), -0.8333, 1e-3);
      EXPECT_NEAR(ToDegrees(ComputeSunPosition(place, *events.sunset).elevation), -0.8333, 1e-3);
      EXPECT_NEAR(std::sin(ComputeSunPosition(place, events.noon).azimuth.value()), 0.0, 1e-4);
    }
  }
}

TEST_F(SunEventsTest, AreMissingInPolarDayAndNight) {
  const Observer tromso = Place(69.65, 18.96);
  for (const char* time : {"2025-12-21T12:00:00Z", "2025-06-21T12:00:00Z"}) {
    const SunEvents events = ComputeSunEvents(tromso, At(time));
    EXPECT_FALSE(events.sunrise) << time;
    EXPECT_FALSE(events.sunset) << time;
    EXPECT_NEAR(SecondsBetween(events.noon, At(time)), -4600.0, 600.0) << time;
  }
  const SunEvents autumn = ComputeSunEvents(tromso, At("2025-09-21T12:00:00Z"));
  EXPECT_TRUE(autumn.sunrise && autumn.sunset);
}

TEST_F(SunEventsTest, SayWhyTheyAreMissing) {
  const auto presence = [](const char* time) {
    return ComputeSunEvents(Place(69.65, 18.96), At(time)).Presence(SunHorizon::kSunrise);
  };
  EXPECT_EQ(presence("2025-06-21T12:00:00Z"), SunPresence::kStaysUp);
  EXPECT_EQ(presence("2025-12-21T12:00:00Z"), SunPresence::kStaysDown);
  EXPECT_EQ(presence("2025-09-21T12:00:00Z"), SunPresence::kPasses);
}

TEST_F(SunEventsTest, HaveTheirTwilightsAroundThem) {
  const SunEvents events = ComputeSunEvents(Place(40.0, -75.0), At("2025-03-10T17:00:00Z"));
  for (std::size_t h = 0; h + 1 < kSunHorizons; ++h) {
    ASSERT_TRUE(events.dawns[h] && events.dawns[h + 1] && events.dusks[h] && events.dusks[h + 1]);
    EXPECT_GT(*events.dawns[h], *events.dawns[h + 1]);
    EXPECT_LT(*events.dusks[h], *events.dusks[h + 1]);
  }
  // In the polar night civil twilight occurs without a sunrise.
  const SunEvents night = ComputeSunEvents(Place(69.65, 18.96), At("2025-12-21T12:00:00Z"));
  EXPECT_TRUE(night.Dawn(SunHorizon::kCivil) && night.Dusk(SunHorizon::kCivil));
  EXPECT_FALSE(night.sunrise);
}

// Between midnight sun and ordinary days the sunset falls after midnight. It still belongs to the
// preceding noon.
TEST_F(SunEventsTest, PairASunsetAfterMidnightWithTheNoonBefore) {
  const Observer fairbanks = Place(64.84, -147.72);
  const SunEvents events = ComputeSunEvents(fairbanks, At("2025-06-10T22:00:00Z"));
  ASSERT_TRUE(events.sunrise && events.sunset);
  EXPECT_LT(*events.sunrise, events.noon);
  EXPECT_LT(events.noon, *events.sunset);
  EXPECT_LT(SecondsBetween(*events.sunset, *events.sunrise), 24 * 3600.0);
  EXPECT_GT(SecondsBetween(*events.sunset, *events.sunrise), 21 * 3600.0);
}

// A sun that sets for minutes at midnight. Each such dip ends one day's light and begins the next
// one's; no event may be lost.
TEST_F(SunEventsTest, LoseNoPassageBetweenTheDays) {
  const Observer place = Place(65.73, 25.0);
  for (int day = 0; day < 20; ++day) {
    const UtcTime noon = At("2025-06-11T10:20:00Z").PlusSeconds(86'400.0 * day);
    const SunEvents today = ComputeSunEvents(place, noon);
    const SunEvents tomorrow = ComputeSunEvents(place, noon.PlusSeconds(86'400.0));
    EXPECT_EQ(today.sunset.has_value(), tomorrow.sunrise.has_value()) << day;
    if (!today.sunset || !tomorrow.sunrise) continue;
    EXPECT_GT(SecondsBetween(*tomorrow.sunrise, *today.sunset), 0.0);
    EXPECT_LT(SecondsBetween(*tomorrow.sunrise, *today.sunset), 5400.0);
  }
}

TEST_F(SunEventsTest, BelongToTheLocalDay) {
  // 23:30 UTC in Sydney is the next morning.
  const SunEvents events = ComputeSunEvents(Place(-33.87, 151.21), At("2025-06-01T23:30:00Z"));
  EXPECT_NEAR(SecondsBetween(events.noon, At("2025-06-02T01:53:00Z")), 0.0, 120.0);
}

}  // namespace
}  // namespace pleinair::sky
