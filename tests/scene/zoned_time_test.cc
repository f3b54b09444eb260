// Zones from Debian's tzdata. Offsets and clock changes: IANA time-zone database, release 2025b.
#include "scene/zoned_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace pleinair::scene {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string Utc(std::string_view text) {
  const Result<ZonedTime> zoned = ParseZonedTime(text);
  return zoned ? zoned->time.ToString() : "error: " + zoned.error().Message();
}

std::string Refusal(std::string_view text) {
  const Result<ZonedTime> zoned = ParseZonedTime(text);
  return zoned ? "taken as " + zoned->time.ToString() : zoned.error().Message();
}

int OffsetMinutes(std::string_view text) {
  return static_cast<int>(ParseZonedTime(text).value().offset.value().count() / 60);
}

TEST(ZonedTime, ReadsRfc3339AsBefore) {
  EXPECT_EQ(Utc("2025-09-14T11:05:00Z"), "2025-09-14T11:05:00Z");
  EXPECT_EQ(Utc("2025-09-14T13:05:00.25+02:00"), "2025-09-14T11:05:00.25Z");
  EXPECT_FALSE(ParseZonedTime("2025-09-14T11:05:00Z").value().offset);
  EXPECT_EQ(OffsetMinutes("2025-09-14T01:35:00-09:30"), -570);
}

TEST(ZonedTime, ReadsLocalTimeWithItsZone) {
  EXPECT_EQ(Utc("2025-09-14T13:05:00[Europe/Prague]"), "2025-09-14T11:05:00Z");
  EXPECT_EQ(Utc("2025-12-14T13:05:00.5[Europe/Prague]"), "2025-12-14T12:05:00.5Z");
  EXPECT_EQ(Utc("2025-07-04 12:00:00[America/New_York]"), "2025-07-04T16:00:00Z");
  EXPECT_EQ(Utc("2025-07-04T12:00:00[Asia/Kathmandu]"), "2025-07-04T06:15:00Z");
  EXPECT_EQ(Utc("2025-07-04T12:00:00[UTC]"), "2025-07-04T12:00:00Z");
  EXPECT_EQ(OffsetMinutes("2025-09-14T13:05:00[Europe/Prague]"), 120);
  EXPECT_EQ(OffsetMinutes("2025-01-14T13:05:00[Europe/Prague]"), 60);
}

// RFC 9557, section 3.4: an offset and the zone must agree; Z makes no statement about local time.
TEST(ZonedTime, TakesAnOffsetThatTheZoneHas) {
  EXPECT_EQ(Utc("2025-09-14T13:05:00+02:00[Europe/Prague]"), "2025-09-14T11:05:00Z");
  EXPECT_EQ(Utc("2025-09-14T11:05:00Z[Europe/Prague]"), "2025-09-14T11:05:00Z");
  EXPECT_EQ(OffsetMinutes("2025-09-14T11:05:00Z[Europe/Prague]"), 120);
  EXPECT_THAT(Refusal("2025-09-14T13:05:00+01:00[Europe/Prague]"),
              AllOf(HasSubstr("has the offset +01:00, but Europe/Prague was at +02:00 then"),
                    HasSubstr("leave out the offset or the zone")));
  EXPECT_THAT(Refusal("2025-09-14T13:05:00+00:00[Europe/Prague]"), HasSubstr("at +02:00 then"));
}

TEST(ZonedTime, RefusesAnHourThatAClockChangeSkips) {
  EXPECT_THAT(Refusal("2025-03-30T02:30:00[Europe/Prague]"),
              AllOf(HasSubstr("does not exist: clocks were set forward from +01:00 to +02:00"),
                    HasSubstr("write 2025-03-30T01:30:00[Europe/Prague] before the change, or "
                              "2025-03-30T03:30:00[Europe/Prague] after it")));
  EXPECT_EQ(Utc("2025-03-30T01:59:59[Europe/Prague]"), "2025-03-30T00:59:59Z");
  EXPECT_EQ(Utc("2025-03-30T03:00:00[Europe/Prague]"), "2025-03-30T01:00:00Z");
  // Samoa crossed the date line.
  EXPECT_THAT(Refusal("2011-12-30T12:00:00[Pacific/Apia]"),
              HasSubstr("write 2011-12-29T12:00:00[Pacific/Apia]"));
}

TEST(ZonedTime, RefusesAnHourThatAClockChangeRepeats) {
  EXPECT_THAT(Refusal("2025-10-26T02:30:00[Europe/Prague]"),
              AllOf(HasSubstr("occurred twice: at +02:00, and at +01:00"),
                    HasSubstr("write 2025-10-26T02:30:00+02:00[Europe/Prague] or "
                              "2025-10-26T02:30:00+01:00[Europe/Prague]")));
  EXPECT_EQ(Utc("2025-10-26T02:30:00+02:00[Europe/Prague]"), "2025-10-26T00:30:00Z");
  EXPECT_EQ(Utc("2025-10-26T02:30:00+01:00[Europe/Prague]"), "2025-10-26T01:30:00Z");
}

TEST(ZonedTime, SuggestsZonesNearAnUnknownOne) {
  EXPECT_THAT(
      Refusal("2025-09-14T13:05:00[Prague]"),
      AllOf(HasSubstr("unknown zone \"Prague\""), HasSubstr("did you mean Europe/Prague?")));
  EXPECT_THAT(Refusal("2025-09-14T13:05:00[europe/prague]"), HasSubstr("mean Europe/Prague?"));
  EXPECT_THAT(Refusal("2025-09-14T13:05:00[Middle/Earthshire]"),
              AllOf(HasSubstr("for example Europe/Prague"), Not(HasSubstr("did you mean"))));
}

// Zone files end in 2037 with a rule for later years, which the date library ignores.
TEST(ZonedTime, RefusesWhatLiesAfterTheClockChangesOfTheDatabase) {
  EXPECT_EQ(Utc("2037-07-01T12:00:00[Europe/Prague]"), "2037-07-01T10:00:00Z");
  for (const char* text :
       {"2040-07-01T12:00:00[Europe/Prague]", "2040-07-01T12:00:00+02:00[Europe/Prague]"}) {
    EXPECT_THAT(Refusal(text), AllOf(HasSubstr("lies after the clock changes"),
                                     HasSubstr("give the time's offset")));
  }
  EXPECT_EQ(Utc("2040-07-01T12:00:00[Asia/Kolkata]"), "2040-07-01T06:30:00Z");
}

TEST(ZonedTime, ReachesTheFirstAndLastYear) {
  EXPECT_EQ(Utc("1678-01-01T00:00:00[Asia/Kolkata]"), "1677-12-31T18:06:32Z");
  EXPECT_EQ(Utc("2261-12-31T23:59:59[Asia/Kolkata]"), "2261-12-31T18:29:59Z");
  // Local mean time offsets have seconds in the database, minutes in RFC 3339.
  EXPECT_EQ(Utc("1860-01-01T12:00:00+00:58[Europe/Prague]"), "1860-01-01T11:02:00Z");
}

TEST(ZonedTime, RefusesBracketsThatHoldNoZone) {
  for (const char* text :
       {"[", "]", "[]", "[Europe/Prague]", "2025-09-14T13:05:00[", "2025-09-14T13:05:00[]",
        "2025-09-14T13:05:00[Europe/Prague", "2025-09-14T13:05:00[Europe/Prague]Z",
        "2025-09-14T13:05:00[Europe/Prague][u-ca=gregory]", "2025-09-14T13:05:00[[Europe/Prague]]",
        "2025-09-14T13:05:00[../zoneinfo/Europe/Prague]", "2025-09-14T13:05:00[+02:00]",
        "2025-02-30T12:00:00[Europe/Prague]", "2025-09-14[Europe/Prague]",
        "2025-09-14T13:05:00 CEST[Europe/Prague]", "2017-01-01T00:59:60[Europe/Prague]",
        "2016-12-31T23:59:60[Europe/Prague]"}) {
    EXPECT_FALSE(ParseZonedTime(text)) << text;
  }
  EXPECT_FALSE(ParseZonedTime("2025-09-14T13:05:00[" + std::string(100'000, 'x') + "]"));
  EXPECT_THAT(Refusal("2025-02-30T12:00:00[Europe/Prague]"),
              HasSubstr("a day that does not exist"));
  EXPECT_EQ(Utc("2016-12-31T23:59:60Z[Europe/Prague]"), "2017-01-01T00:00:00Z");
}

TEST(ZonedTime, OffersAZoneWhereTheOffsetIsMissing) {
  EXPECT_THAT(Refusal("2025-09-14T13:05:00"),
              AllOf(HasSubstr("neither Z nor an offset"),
                    HasSubstr("+02:00, or Z for UTC, or name its zone")));
  EXPECT_THAT(Refusal("yesterday"), Not(HasSubstr("name its zone")));
}

}  // namespace
}  // namespace pleinair::scene
