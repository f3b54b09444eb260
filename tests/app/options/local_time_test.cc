#include "app/options/local_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace pleinair::app {
namespace {

using ::testing::HasSubstr;

UtcTime At(const std::string& text) { return UtcTime::Parse(text).value(); }

TEST(UtcOffset, ReadsWhatPeopleWrite) {
  const auto minutes = [](const char* text) {
    return ParseUtcOffset(text, "--utc-offset").value().minutes;
  };
  EXPECT_EQ(minutes("+02:00"), 120);
  EXPECT_EQ(minutes("-09:30"), -570);
  EXPECT_EQ(minutes("-9:30"), -570);
  EXPECT_EQ(minutes("+5"), 300);
  EXPECT_EQ(minutes("+05:45"), 345);
  EXPECT_EQ(minutes("+14:00"), 840);
  EXPECT_EQ(minutes("-00:44"), -44);
  EXPECT_EQ(minutes("Z"), 0);
}

TEST(UtcOffset, RefusesWhatIsNoOffset) {
  for (const char* text : {"", "+", "2", "02:00", "+16:00", "+02:60", "+2:0", "+02:000",
                           "+2:", "CET", "+0x", "+ 2", "+2 ", "++2", "+002", "+02-00"}) {
    const auto offset = ParseUtcOffset(text, "--utc-offset");
    ASSERT_FALSE(offset) << text;
    EXPECT_EQ(offset.error().where, "--utc-offset");
  }
}

TEST(UtcOffset, IsWrittenAsItIsRead) {
  for (const char* text : {"+02:00", "-09:30", "+14:00", "-00:44", "Z"}) {
    EXPECT_EQ(ToString(ParseUtcOffset(text, "").value()), text);
  }
}

TEST(UtcOffset, StandsAtTheEndOfATime) {
  EXPECT_EQ(OffsetOf("2025-06-21T00:05:00+02:00"), UtcOffset{120});
  EXPECT_EQ(OffsetOf("2025-06-21T00:05:00.25-09:30"), UtcOffset{-570});
  EXPECT_EQ(OffsetOf("2025-06-21T00:05:00Z"), std::nullopt);
  EXPECT_EQ(OffsetOf("2025-06-21T00:05:00+20:00"), std::nullopt);
  EXPECT_EQ(OffsetOf(""), std::nullopt);
}

TEST(UtcOffset, OfAZoneIsThatOfItsMoment) {
  EXPECT_EQ(OffsetOf("2025-06-21T00:05:00[Europe/Prague]"), UtcOffset{120});
  EXPECT_EQ(OffsetOf("2025-12-21T00:05:00[Europe/Prague]"), UtcOffset{60});
  EXPECT_EQ(OffsetOf("2025-06-21T00:05:00Z[Asia/Kathmandu]"), UtcOffset{345});
}

TEST(TimeOption, NamesItselfInErrors) {
  EXPECT_EQ(ParseTimeOption("--time", "2025-09-14T13:05:00[Europe/Prague]").value(),
            At("2025-09-14T11:05:00Z"));
  EXPECT_EQ(ParseTimeOption("--time", "2025-09-14T13:05:00").error().where, "--time");
  EXPECT_EQ(ParseTimeOption("--time", "2025-09-14T13:05:00[Prague]").error().where, "--time");
}

TEST(UtcOffset, OfASailorIsTheNearestHour) {
  EXPECT_EQ(NauticalOffset(14.4).minutes, 60);
  EXPECT_EQ(NauticalOffset(-157.4).minutes, -600);
  EXPECT_EQ(NauticalOffset(7.4).minutes, 0);
  EXPECT_EQ(NauticalOffset(345.0).minutes, -60);
}

TEST(LocalDay, BeginsAtTheClocksMidnight) {
  EXPECT_EQ(ParseDay("2025-06-21", UtcOffset{120}, "--day").value(), At("2025-06-20T22:00:00Z"));
  EXPECT_EQ(ParseDay("2011-12-31", UtcOffset{840}, "--day").value(), At("2011-12-30T10:00:00Z"));
  EXPECT_EQ(ParseDay("2024-02-29", UtcOffset{-570}, "--day").value(), At("2024-02-29T09:30:00Z"));
  for (const char* date :
       {"2025-02-29", "2025-6-21", "21.06.2025", "2025-13-01", "1500-01-01", "2025-06-211", ""}) {
    EXPECT_FALSE(ParseDay(date, UtcOffset{}, "--day")) << date;
  }
  // An invalid date is reported before an unknown zone.
  EXPECT_THAT(ParseDay("2025-02-30", std::nullopt, "--day").error().what, HasSubstr("not a day"));
  EXPECT_THAT(ParseDay("2025-02-28", std::nullopt, "--day").error().what,
              HasSubstr("the clock's offset"));
}

TEST(LocalTime, IsWrittenToTheNearestSecond) {
  EXPECT_EQ(FormatLocal(At("2025-06-20T22:04:59.6Z"), {120}), "2025-06-21T00:05:00+02:00");
  EXPECT_EQ(FormatLocal(At("2025-06-20T22:04:59.4Z"), {}), "2025-06-20T22:04:59Z");
  EXPECT_EQ(FormatLocal(At("1950-01-01T00:00:00.7Z"), {}), "1950-01-01T00:00:01Z");
  EXPECT_EQ(FormatLocal(At("1969-12-31T23:59:59.6Z"), {-60}), "1969-12-31T23:00:00-01:00");
  EXPECT_EQ(FormatLocalDate(At("2025-06-20T22:30:00Z"), {120}), "2025-06-21");
}

}  // namespace
}  // namespace pleinair::app
