#include "base/utc_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pleinair {
namespace {

using ::testing::HasSubstr;

std::int64_t Seconds(std::string_view text) {
  const Result<UtcTime> time = UtcTime::Parse(text);
  EXPECT_TRUE(time.has_value()) << text << ": " << (time ? "" : time.error().Message());
  return time ? time->nanoseconds_since_1970() / 1'000'000'000 : 0;
}

std::string Rewritten(std::string_view text) {
  const Result<UtcTime> time = UtcTime::Parse(text);
  return time ? time->ToString() : "error: " + time.error().Message();
}

std::string Refusal(std::string_view text) {
  const Result<UtcTime> time = UtcTime::Parse(text);
  return time ? "taken as " + time->ToString() : time.error().Message();
}

// RFC 3339, section 5.8.
TEST(UtcTime, ReadsTheExamplesOfRfc3339) {
  EXPECT_EQ(Rewritten("1985-04-12T23:20:50.52Z"), "1985-04-12T23:20:50.52Z");
  EXPECT_EQ(Rewritten("1996-12-19T16:39:57-08:00"), "1996-12-20T00:39:57Z");
  EXPECT_EQ(Rewritten("1990-12-31T23:59:60Z"), "1991-01-01T00:00:00Z");
  EXPECT_EQ(Rewritten("1990-12-31T15:59:60-08:00"), "1991-01-01T00:00:00Z");
  for (const char* none : {"2025-01-01T12:00:60Z", "2025-03-10T12:34:60Z",
                           "2024-12-31T23:59:60-08:00", "2024-03-31T23:59:60Z"}) {
    EXPECT_FALSE(UtcTime::Parse(none).has_value()) << none;
  }
  EXPECT_EQ(Rewritten("1937-01-01T12:00:27.87+00:20"), "1937-01-01T11:40:27.87Z");
}

TEST(UtcTime, CountsPosixSeconds) {
  EXPECT_EQ(Seconds("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(Seconds("2001-09-09T01:46:40Z"), 1'000'000'000);
  EXPECT_EQ(Seconds("2038-01-19T03:14:07Z"), 2'147'483'647);
  EXPECT_EQ(Seconds("1901-12-13T20:45:52Z"), -2'147'483'648LL);
}

TEST(UtcTime, TakesASpaceAndSmallLetters) {
  EXPECT_EQ(Rewritten("2025-09-14 11:05:00z"), "2025-09-14T11:05:00Z");
  EXPECT_EQ(Rewritten("2025-09-14t13:05:00+02:00"), "2025-09-14T11:05:00Z");
}

TEST(UtcTime, RefusesLocalTimeBecauseItsZoneIsUnknown) {
  EXPECT_THAT(Refusal("2025-09-14T11:05:00"), HasSubstr("neither Z nor an offset"));
  EXPECT_THAT(Refusal("2025-09-14T11:05:00.25"), HasSubstr("neither Z nor an offset"));
  EXPECT_THAT(Refusal("2025-09-14T11:05:00 CEST"), HasSubstr("neither Z nor an offset"));
  EXPECT_THAT(Refusal("2025-09-14T11:05:00"), HasSubstr("for example 2025-09-14T11:05:00Z"));
}

TEST(UtcTime, RefusesDaysAndHoursThatDoNotExist) {
  EXPECT_THAT(Refusal("2025-02-29T00:00:00Z"), HasSubstr("a day that does not exist"));
  EXPECT_THAT(Refusal("1900-02-29T00:00:00Z"), HasSubstr("a day that does not exist"));
  EXPECT_THAT(Refusal("2025-13-01T00:00:00Z"), HasSubstr("a day that does not exist"));
  EXPECT_THAT(Refusal("2025-01-01T24:00:00Z"), HasSubstr("an hour that does not exist"));
  EXPECT_THAT(Refusal("2025-02-30T12:00:00"), HasSubstr("a day that does not exist"));
  EXPECT_THAT(Refusal("2025-01-01T00:00:00+24:00"), HasSubstr("bad offset"));
  EXPECT_EQ(Rewritten("2000-02-29T00:00:00Z"), "2000-02-29T00:00:00Z");
}

TEST(UtcTime, RefusesWhatIsNoTimeOrGoesOn) {
  for (const char* text : {"", "2025", "2025-09-14", "2025-9-14T11:05:00Z", "14.9.2025 11:05",
                           "2025-09-14T11:05Z", "2025-09-14T11:05:00.Z", "2025-09-14T11:05:00Zulu",
                           "2025-09-14T11:05:00+0200", "+025-09-14T11:05:00Z"}) {
    EXPECT_FALSE(UtcTime::Parse(text)) << text;
  }
}

TEST(UtcTime, ReachesTheYearsThatNanosecondsReach) {
  EXPECT_EQ(Rewritten("1678-01-01T00:00:00Z"), "1678-01-01T00:00:00Z");
  EXPECT_EQ(Rewritten("2261-12-31T23:59:59.999999999Z"), "2261-12-31T23:59:59.999999999Z");
  EXPECT_THAT(Refusal("1677-12-31T00:00:00Z"), HasSubstr("1678 to 2261"));
  EXPECT_THAT(Refusal("9999-12-31T00:00:00Z"), HasSubstr("1678 to 2261"));
}

TEST(UtcTime, SplitsIntoCivilTimeAndBack) {
  for (std::int64_t day = -100'000; day <= 100'000; day += 37) {
    const UtcTime time(day * 86'400'000'000'000 + 45'296'500'000'000);  // 12:34:56.5
    const UtcTime::Civil civil = time.ToCivil();
    EXPECT_EQ(civil.hour, 12);
    EXPECT_EQ(civil.minute, 34);
    EXPECT_DOUBLE_EQ(civil.second, 56.5);
    const Result<UtcTime> again = UtcTime::Parse(time.ToString());
    ASSERT_TRUE(again) << time.ToString();
    EXPECT_EQ(*again, time);
  }
}

TEST(UtcTime, AddsSecondsToTheNearestNanosecond) {
  const UtcTime start(1'000);
  EXPECT_EQ(start.PlusSeconds(1e-9).nanoseconds_since_1970(), 1'001);
  EXPECT_EQ(start.PlusSeconds(-2e-6).nanoseconds_since_1970(), -1'000);
  EXPECT_EQ(start.PlusSeconds(1.0 / 15.0).nanoseconds_since_1970(), 66'667'667);
}

}  // namespace
}  // namespace pleinair
