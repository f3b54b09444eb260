#include "sky/sun/sun_day.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sky/sun/sun_clock.h"

namespace pleinair::sky {
namespace {

UtcTime At(const std::string& text) { return UtcTime::Parse(text).value(); }

Observer Place(double latitude_deg, double longitude_deg) {
  return {.latitude = FromDegrees(latitude_deg), .longitude = FromDegrees(longitude_deg)};
}

double SecondsBetween(UtcTime a, UtcTime b) {
  return static_cast<double>(a.nanoseconds_since_1970() - b.nanoseconds_since_1970()) * 1e-9;
}

SunDay CalendarDay(const Observer& place, const std::string& date, double offset_h) {
  const UtcTime begin = At(date + "T00:00:00Z").PlusSeconds(-3600.0 * offset_h);
  return ComputeSunDay(place, begin, begin.PlusSeconds(86'400.0));
}

class SunDayTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!HasPreciseSun()) GTEST_SKIP() << "built without ERFA";
  }
};

struct ReferenceDay {
  double latitude_deg, longitude_deg, offset_h;
  const char* date;
  const char* rise;  // Empty: none.
  const char* noon;
  const char* set;
};

// A root search in steps of a minute on airless topocentric elevations of another library
// (astronomy-engine 2.1.19). Like ours it takes UTC for UT1.
constexpr ReferenceDay kReferenceDays[] = {
    {50.0875, 14.4213, 1, "1955-03-21", "1955-03-21T05:05:01.0Z", "1955-03-21T11:09:46.0Z",
     "1955-03-21T17:15:28.5Z"},
    {50.0875, 14.4213, 1, "2025-06-21", "2025-06-21T02:52:33.7Z", "2025-06-21T11:04:09.7Z",
     "2025-06-21T19:15:45.1Z"},
    {-33.87, 151.21, 10, "2003-10-17", "2003-10-16T19:12:24.0Z", "2003-10-17T01:40:40.5Z",
     "2003-10-17T08:09:30.1Z"},
    {-33.87, 151.21, 10, "2025-12-21", "2025-12-20T18:40:45.1Z", "2025-12-21T01:53:08.0Z",
     "2025-12-21T09:05:31.5Z"},
    {-33.87, 151.21, 10, "2099-05-05", "2099-05-04T20:32:51.2Z", "2099-05-05T01:51:57.5Z",
     "2099-05-05T07:10:41.7Z"},
    {0, -78.5, -5, "1968-07-04", "1968-07-04T11:14:42.5Z", "1968-07-04T17:18:21.6Z",
     "1968-07-04T23:22:00.6Z"},
    {0, -78.5, -5, "2048-02-29", "2048-02-29T11:22:59.0Z", "2048-02-29T17:26:17.2Z",
     "2048-02-29T23:29:35.3Z"},
    {64.84, -147.72, -10, "1968-07-04", "1968-07-04T11:18:40.5Z", "1968-07-04T21:55:16.4Z",
     "1968-07-05T08:29:35.8Z"},
    {64.84, -147.72, -10, "2003-10-17", "2003-10-17T16:49:14.3Z", "2003-10-17T21:36:13.4Z",
     "2003-10-18T02:21:52.4Z"},
    {64.84, -147.72, -10, "2099-05-05", "2099-05-05T13:01:16.1Z", "2099-05-05T21:47:36.9Z",
     "2099-05-06T06:36:31.9Z"},
    {-54.8, -68.3, -5, "1987-11-02", "1987-11-02T08:43:30.4Z", "1987-11-02T16:16:47.1Z",
     "1987-11-02T23:51:23.4Z"},
    {-54.8, -68.3, -5, "2025-12-21", "2025-12-21T07:51:32.5Z", "2025-12-21T16:31:28.7Z",
     "2025-12-22T01:11:24.6Z"},
    {39.742476, -105.1786, -7, "1955-03-21", "1955-03-21T13:03:37.8Z", "1955-03-21T19:08:04.0Z",
     "1955-03-22T01:13:10.2Z"},
    {39.742476, -105.1786, -7, "1987-11-02", "1987-11-02T13:30:05.0Z", "1987-11-02T18:44:17.8Z",
     "1987-11-02T23:58:00.9Z"},
    {39.742476, -105.1786, -7, "2025-12-21", "2025-12-21T14:18:25.9Z", "2025-12-21T18:59:02.6Z",
     "2025-12-21T23:39:39.4Z"},
    {69.65, 18.96, 1, "1987-11-02", "1987-11-02T07:12:45.9Z", "1987-11-02T10:27:44.9Z",
     "1987-11-02T13:41:25.3Z"},
    {69.65, 18.96, 1, "2025-06-21", "", "2025-06-21T10:46:00.3Z", ""},
    {69.65, 18.96, 1, "2048-02-29", "2048-02-29T06:11:41.1Z", "2048-02-29T10:56:30.0Z",
     "2048-02-29T15:43:03.3Z"},
    {35.68, 139.77, 9, "1955-03-21", "1955-03-20T20:45:03.9Z", "1955-03-21T02:48:28.5Z",
     "1955-03-21T08:52:27.5Z"},
    {35.68, 139.77, 9, "2025-12-21", "2025-12-20T21:46:40.4Z", "2025-12-21T02:38:54.6Z",
     "2025-12-21T07:31:08.4Z"},
    {35.68, 139.77, 9, "2099-05-05", "2099-05-04T19:45:05.3Z", "2099-05-05T02:37:43.0Z",
     "2099-05-05T09:30:52.1Z"},
    {21.31, -157.86, -11, "2003-10-17", "2003-10-17T16:27:48.3Z", "2003-10-17T22:16:46.6Z",
     "2003-10-18T04:05:28.1Z"},
    {21.31, -157.86, -11, "2099-05-05", "2099-05-05T15:57:56.6Z", "2099-05-05T22:28:10.3Z",
     "2099-05-06T04:58:39.9Z"},
    {59.33, 18.06, 1, "2003-10-17", "2003-10-17T05:29:05.8Z", "2003-10-17T10:33:11.8Z",
     "2003-10-17T15:36:11.9Z"},
    {59.33, 18.06, 1, "2099-05-05", "2099-05-05T02:38:20.1Z", "2099-05-05T10:44:31.7Z",
     "2099-05-05T18:52:22.8Z"},
};

TEST_F(SunDayTest, RisesCulminatesAndSetsWithinTwoSecondsOfAnotherLibrary) {
  for (const ReferenceDay& row : kReferenceDays) {
    SCOPED_TRACE(::testing::Message()
                 << row.latitude_deg << "," << row.longitude_deg << " " << row.date);
    const SunDay day =
        CalendarDay(Place(row.latitude_deg, row.longitude_deg), row.date, row.offset_h);
    const HorizonPassages& horizon = day.At(SunHorizon::kSunrise);
    ASSERT_EQ(horizon.rises.size(), *row.rise == 0 ? 0u : 1u);
    ASSERT_EQ(horizon.sets.size(), *row.set == 0 ? 0u : 1u);
    ASSERT_EQ(day.noons.size(), 1u);
    if (*row.rise != 0) {
      EXPECT_NEAR(SecondsBetween(horizon.rises[0], At(row.rise)), 0.0, 2.0);
    }
    EXPECT_NEAR(SecondsBetween(day.noons[0], At(row.noon)), 0.0, 1.0);
    if (*row.set != 0) {
      EXPECT_NEAR(SecondsBetween(horizon.sets[0], At(row.set)), 0.0, 2.0);
    }
  }
}

// Reda & Andreas 2004, Table A5.1, zone -7 h: sunrise 6.212067 h, transit 11.768045 h, sunset
// 17.338667 h.
TEST_F(SunDayTest, HasNrelsSunriseTransitAndSunset) {
  const Observer place = Place(39.742476, -105.1786);
  const SunDay day = CalendarDay(place, "2003-10-17", -7.0);
  ASSERT_EQ(day.At(SunHorizon::kSunrise).rises.size(), 1u);
  EXPECT_NEAR(SecondsBetween(day.At(SunHorizon::kSunrise).rises[0], day.begin), 6.212067 * 3600.0,
              3.0);
  EXPECT_NEAR(SecondsBetween(day.noons.at(0), day.begin), 11.768045 * 3600.0, 1.0);
  // Their event falls on 17 October UT, which is the 16th in that zone; a day later it is 88 s
  // earlier.
  const SunDay eve = CalendarDay(place, "2003-10-16", -7.0);
  ASSERT_EQ(eve.At(SunHorizon::kSunrise).sets.size(), 1u);
  EXPECT_NEAR(SecondsBetween(eve.At(SunHorizon::kSunrise).sets[0], eve.begin), 17.338667 * 3600.0,
              3.0);
}

// The same library: days with more or fewer than one of each event.
TEST_F(SunDayTest, HoldsTwoSunsetsWhereTheyPassMidnight) {
  const SunDay day = CalendarDay(Place(64.84, -147.72), "2025-07-15", -8.0);
  const HorizonPassages& horizon = day.At(SunHorizon::kSunrise);
  ASSERT_EQ(horizon.rises.size(), 1u);
  ASSERT_EQ(horizon.sets.size(), 2u);
  EXPECT_NEAR(SecondsBetween(horizon.sets[0], At("2025-07-15T08:00:24.9Z")), 0.0, 3.0);
  EXPECT_NEAR(SecondsBetween(horizon.rises[0], At("2025-07-15T11:53:55.1Z")), 0.0, 3.0);
  EXPECT_NEAR(SecondsBetween(horizon.sets[1], At("2025-07-16T07:57:15.0Z")), 0.0, 3.0);
  EXPECT_NEAR(horizon.seconds_above,
              86'400.0 - SecondsBetween(horizon.rises[0], horizon.sets[0]) -
                  SecondsBetween(day.end, horizon.sets[1]),
              1e-3);
}

TEST_F(SunDayTest, HoldsNoSunsetWhereTheSunSetsAfterMidnight) {
  const SunDay day = CalendarDay(Place(64.84, -147.72), "2025-05-30", -8.0);
  const HorizonPassages& horizon = day.At(SunHorizon::kSunrise);
  ASSERT_EQ(horizon.rises.size(), 1u);
  EXPECT_NEAR(SecondsBetween(horizon.rises[0], At("2025-05-30T11:36:49.3Z")), 0.0, 3.0);
  EXPECT_TRUE(horizon.sets.empty());
  EXPECT_FALSE(horizon.Always());
}

TEST_F(SunDayTest, FollowsTheCalendarOnEitherSideOfTheDateLine) {
  // Samoa skipped 30 December 2011: its 29th was at UTC-10, its 31st at UTC+14.
  const Observer apia = Place(-13.83, -171.77);
  const SunDay before = CalendarDay(apia, "2011-12-29", -10.0);
  const SunDay after = CalendarDay(apia, "2011-12-31", 14.0);
  EXPECT_EQ(before.end, after.begin);
  EXPECT_NEAR(
      SecondsBetween(before.At(SunHorizon::kSunrise).rises.at(0), At("2011-12-29T17:01:03.3Z")),
      0.0, 2.0);
  EXPECT_NEAR(
      SecondsBetween(after.At(SunHorizon::kSunrise).rises.at(0), At("2011-12-30T17:01:36.9Z")), 0.0,
      2.0);
  EXPECT_NEAR(
      SecondsBetween(after.At(SunHorizon::kSunrise).sets.at(0), At("2011-12-31T05:57:40.3Z")), 0.0,
      2.0);
  EXPECT_EQ(before.noons.size(), 1u);
  EXPECT_EQ(after.noons.size(), 1u);
}

TEST_F(SunDayTest, FindsASunThatDipsUnderTheHorizonForFourMinutes) {
  const SunDay dips = CalendarDay(Place(65.73, 25.0), "2025-06-21", 3.0);
  const HorizonPassages& horizon = dips.At(SunHorizon::kSunrise);
  ASSERT_EQ(horizon.sets.size(), 1u);
  ASSERT_EQ(horizon.rises.size(), 1u);
  // The sun moves along the horizon: a thousandth of a degree takes a minute and a half.
  EXPECT_NEAR(SecondsBetween(horizon.sets[0], At("2025-06-20T22:19:43.5Z")), 0.0, 20.0);
  EXPECT_NEAR(SecondsBetween(horizon.rises[0], At("2025-06-20T22:23:44.2Z")), 0.0, 20.0);
  EXPECT_TRUE(CalendarDay(Place(65.74, 25.0), "2025-06-21", 3.0).At(SunHorizon::kSunrise).Always());
}

TEST_F(SunDayTest, SaysWhetherTheSunStaysUpOrDown) {
  const Observer tromso = Place(69.65, 18.96);
  const auto horizon = [&](const char* date, double offset_h) {
    return CalendarDay(tromso, date, offset_h).At(SunHorizon::kSunrise);
  };
  EXPECT_TRUE(horizon("2025-05-18", 2.0).Always());
  EXPECT_EQ(horizon("2025-05-18", 2.0).seconds_above, 86'400.0);
  EXPECT_TRUE(horizon("2025-11-27", 1.0).Never());
  EXPECT_EQ(horizon("2025-11-27", 1.0).seconds_above, 0.0);
  EXPECT_TRUE(horizon("2025-01-14", 2.0).Never());
  const HorizonPassages first = horizon("2025-01-15", 2.0);
  ASSERT_EQ(first.rises.size(), 1u);
  ASSERT_EQ(first.sets.size(), 1u);
  EXPECT_NEAR(SecondsBetween(first.rises[0], At("2025-01-15T10:24:58.0Z")), 0.0, 5.0);
  EXPECT_NEAR(SecondsBetween(first.sets[0], At("2025-01-15T11:23:01.4Z")), 0.0, 5.0);
  const HorizonPassages last = horizon("2025-05-17", 2.0);
  EXPECT_EQ(last.sets.size(), 1u);
  EXPECT_EQ(last.rises.size(), 1u);
  // Polar night still has civil twilight; white nights have no end of twilight.
  EXPECT_EQ(CalendarDay(tromso, "2025-12-21", 1.0).At(SunHorizon::kCivil).rises.size(), 1u);
  EXPECT_TRUE(CalendarDay(Place(61.0, 30.0), "2025-06-21", 3.0).At(SunHorizon::kCivil).Always());
}

TEST_F(SunDayTest, HasOneSunriseAndOneSunsetAYearAtThePoles) {
  const auto span = [](double latitude, const char* date) {
    const UtcTime begin = At(std::string(date) + "T00:00:00Z");
    return ComputeSunDay(Place(latitude, 0.0), begin, begin.PlusSeconds(20 * 86'400.0));
  };
  const SunDay north_spring = span(90.0, "2025-03-10"), south_autumn = span(-90.0, "2025-03-10");
  const SunDay north_autumn = span(90.0, "2025-09-15"), south_spring = span(-90.0, "2025-09-15");
  const auto expect = [](const std::vector<UtcTime>& found, const char* time) {
    ASSERT_EQ(found.size(), 1u);
    // A second is 0.016" of elevation: the models' difference of 0.5" is half a minute or more.
    EXPECT_NEAR(SecondsBetween(found[0], At(time)), 0.0, 90.0);
  };
  expect(north_spring.At(SunHorizon::kSunrise).rises, "2025-03-18T06:34:42Z");
  expect(south_autumn.At(SunHorizon::kSunrise).sets, "2025-03-22T11:30:43Z");
  expect(south_spring.At(SunHorizon::kSunrise).rises, "2025-09-20T15:04:13Z");
  EXPECT_EQ(north_autumn.At(SunHorizon::kSunrise).sets.size(), 1u);
  EXPECT_TRUE(north_spring.At(SunHorizon::kSunrise).sets.empty());
  EXPECT_TRUE(south_spring.At(SunHorizon::kSunrise).sets.empty());
  // The hour angle still grows: noon is at the meridian of the given longitude.
  EXPECT_EQ(north_spring.noons.size(), 20u);
  EXPECT_EQ(north_spring.midnights.size(), 20u);
}

TEST_F(SunDayTest, HoldsNoNoonOrTwoWhereTheyPassMidnight) {
  // A clock that is twelve hours off. In December noon is 30 s later every day, in September 21 s
  // earlier.
  const auto noons_of_the_year = [](double offset_h) {
    int none = 0, two = 0;
    const Observer place = Place(0.0, 0.0);
    for (int day = 0; day < 365; day += 1) {
      const UtcTime begin =
          At("2025-01-01T00:00:00Z").PlusSeconds(86'400.0 * day - 3600 * offset_h);
      const UtcTime end = begin.PlusSeconds(86'400.0);
      // The hour angles at both ends determine the number of transits.
      const bool at_begin = HourAngle(place, begin).value() > 0.0;
      const bool at_end = HourAngle(place, end).value() > 0.0;
      if (at_begin == at_end) continue;
      const std::size_t noons = ComputeSunDay(place, begin, end).noons.size();
      none += noons == 0 ? 1 : 0;
      two += noons == 2 ? 1 : 0;
    }
    return std::pair(none, two);
  };
  // The equation of time passes zero four times a year.
  EXPECT_EQ(noons_of_the_year(12.0), std::pair(2, 2));
}

TEST_F(SunDayTest, OrdersItsTwilights) {
  for (const double latitude : {-65.0, -35.0, 0.0, 25.0, 45.0}) {
    const SunDay day = CalendarDay(Place(latitude, 0.0), "2025-03-10", 0.0);
    for (std::size_t h = 0; h < kSunHorizons; ++h) {
      const auto horizon = static_cast<SunHorizon>(h);
      const HorizonPassages& passages = day.At(horizon);
      ASSERT_EQ(passages.rises.size(), 1u) << latitude << " " << h;
      ASSERT_EQ(passages.sets.size(), 1u) << latitude << " " << h;
      for (const UtcTime time : {passages.rises[0], passages.sets[0]}) {
        EXPECT_NEAR(ToDegrees(ComputeSunPosition(Place(latitude, 0.0), time).elevation),
                    ToDegrees(HorizonElevation(horizon)), 1e-3);
      }
      if (h > 0) {
        EXPECT_LT(passages.rises[0], day.passages[h - 1].rises[0]);
        EXPECT_GT(passages.sets[0], day.passages[h - 1].sets[0]);
      }
    }
  }
}

TEST_F(SunDayTest, GivesTheSamePassagesForAMonthAsForItsDays) {
  const Observer place = Place(50.0875, 14.4213);
  const UtcTime begin = At("2025-02-01T00:00:00Z");
  const SunDay month = ComputeSunDay(place, begin, begin.PlusSeconds(28 * 86'400.0));
  ASSERT_EQ(month.At(SunHorizon::kSunrise).rises.size(), 28u);
  double above_s = 0.0;
  for (int i = 0; i < 28; ++i) {
    const UtcTime start = begin.PlusSeconds(86'400.0 * i);
    const SunDay day = ComputeSunDay(place, start, start.PlusSeconds(86'400.0));
    EXPECT_NEAR(SecondsBetween(day.At(SunHorizon::kSunrise).rises.at(0),
                               month.At(SunHorizon::kSunrise).rises[i]),
                0.0, 0.2);
    above_s += day.At(SunHorizon::kSunrise).seconds_above;
  }
  EXPECT_NEAR(above_s, month.At(SunHorizon::kSunrise).seconds_above, 5.0);
}

TEST(SunDay, OfThePapersModelIsWithinItsErrors) {
  const Observer place = Place(50.0875, 14.4213);
  const UtcTime begin = At("2025-09-14T00:00:00Z");
  const SunDay day = ComputeSunDay(place, begin, begin.PlusSeconds(86'400.0), SunModel::kPaper);
  const HorizonPassages& horizon = day.At(SunHorizon::kSunrise);
  ASSERT_EQ(horizon.rises.size(), 1u);
  ASSERT_EQ(horizon.sets.size(), 1u);
  // At this latitude 1.4 degrees take nine minutes.
  EXPECT_NEAR(SecondsBetween(horizon.rises[0], At("2025-09-14T04:38:00Z")), 0.0, 540.0);
  EXPECT_NEAR(SecondsBetween(horizon.sets[0], At("2025-09-14T17:18:00Z")), 0.0, 540.0);
}

// Meeus 1998, "Astronomical Algorithms", Example 28.a: 1992 October 13, 0h TD: 3.427351 degrees =
// 822.56 s. His mean sun uses dynamical time, ours universal time: 0.0027379 x 59 s = 0.16 s less
// (Seidelmann 1992, "Explanatory Supplement", section 9.311).
TEST_F(SunDayTest, KnowsTheEquationOfTime) {
  EXPECT_NEAR(EquationOfTimeSeconds(At("1992-10-12T23:59:00.816Z")), 822.56 - 0.16, 0.06);
  // Turning points and zeros from almanacs: 11 February -14 min 13 s, 14 May +3 min 39 s, 26 July
  // -6 min 33 s, 3 November +16 min 28 s.
  const auto at_noon = [](const char* date) {
    return EquationOfTimeSeconds(At(std::string(date) + "T12:00:00Z"));
  };
  EXPECT_NEAR(at_noon("2025-02-11"), -853.0, 4.0);
  EXPECT_NEAR(at_noon("2025-05-14"), 219.0, 4.0);
  EXPECT_NEAR(at_noon("2025-07-26"), -393.0, 4.0);
  EXPECT_NEAR(at_noon("2025-11-03"), 988.0, 4.0);
  // UT1 shifts the sun and the clock equally.
  EXPECT_NEAR(EquationOfTimeSeconds(At("2025-02-11T12:00:00Z"), 0.5), at_noon("2025-02-11"), 2e-3);
}

TEST_F(SunDayTest, HasItsNoonWhenTheEquationOfTimeSays) {
  const Observer place = Place(48.0, 11.5);
  for (const char* date : {"1960-02-11", "2025-06-01", "2090-11-03"}) {
    const SunDay day = CalendarDay(place, date, 1.0);
    const UtcTime noon = day.noons.at(0);
    const double mean_noon_s = 43'200.0 - 11.5 * 240.0 - EquationOfTimeSeconds(noon);
    EXPECT_NEAR(SecondsBetween(noon, At(std::string(date) + "T00:00:00Z")), mean_noon_s, 0.2);
  }
}

TEST_F(SunDayTest, HasAnHourAngleThatGrowsEvenlyAtEveryLatitude) {
  for (const double latitude : {-90.0, -89.99, -23.0, 0.0, 23.4, 66.0, 90.0}) {
    const Observer place = Place(latitude, 30.0);
    const UtcTime time = At("2025-06-21T03:00:00Z");
    for (int quarter = 0; quarter < 96; ++quarter) {
      const double before = HourAngle(place, time.PlusSeconds(900.0 * quarter)).value();
      const double after = HourAngle(place, time.PlusSeconds(900.0 * (quarter + 1))).value();
      const double grown = std::remainder(after - before, 2.0 * M_PI);
      EXPECT_NEAR(ToDegrees(Radians(grown)), 3.75, 0.005) << latitude << " " << quarter;
    }
  }
}

}  // namespace
}  // namespace pleinair::sky
