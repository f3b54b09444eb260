#include "app/sun/sun_table.h"

#include <gtest/gtest.h>

#include <string>

namespace pleinair::app {
namespace {

Result<SunTable> Parse(std::string_view text) { return ParseSunTable(text, "points.csv", {}); }

std::string ErrorOf(std::string_view text) {
  const Result<SunTable> table = Parse(text);
  return table ? "no error" : table.error().Message();
}

TEST(SunTable, TakesColumnsByNameInAnyOrder) {
  const std::string text = "lon,utc,height_m,lat\n14.5,2025-09-14T11:05:00Z,220,50\n";
  const Result<SunTable> table = Parse(text);
  ASSERT_TRUE(table) << table.error().Message();
  ASSERT_EQ(table->rows.size(), 1u);
  const SunTableRow& row = table->rows[0];
  EXPECT_NEAR(ToDegrees(row.observer.longitude), 14.5, 1e-12);
  EXPECT_NEAR(ToDegrees(row.observer.latitude), 50.0, 1e-12);
  EXPECT_EQ(row.observer.height.value(), 220.0);
  EXPECT_EQ(row.observer.pressure_mbar, 1010.0);
  EXPECT_EQ(row.time.ToString(), "2025-09-14T11:05:00Z");
  EXPECT_EQ(table->header, "lon,utc,height_m,lat");
  EXPECT_EQ(row.text, "14.5,2025-09-14T11:05:00Z,220,50");
}

TEST(SunTable, KeepsOtherColumnsWithTheirQuotes) {
  const std::string text =
      "name,utc,lat,lon\n\"Ust, \"\"north\"\"\nside\",2025-01-01T00:00:00Z,\"1.5\",+2\n";
  const Result<SunTable> table = Parse(text);
  ASSERT_TRUE(table) << table.error().Message();
  EXPECT_EQ(table->rows[0].text, "\"Ust, \"\"north\"\"\nside\",2025-01-01T00:00:00Z,\"1.5\",+2");
  EXPECT_NEAR(ToDegrees(table->rows[0].observer.latitude), 1.5, 1e-12);
}

TEST(SunTable, UnderstandsByteOrderMarkCrlfAndNoLastLineEnd) {
  const std::string text =
      "\xEF\xBB\xBFutc,lat,lon\r\n2025-01-01T00:00:00Z,1,2\r\n2025-01-01T00:00:00Z,3,4";
  const Result<SunTable> table = Parse(text);
  ASSERT_TRUE(table) << table.error().Message();
  EXPECT_EQ(table->header, "utc,lat,lon");
  ASSERT_EQ(table->rows.size(), 2u);
  EXPECT_EQ(table->rows[0].text, "2025-01-01T00:00:00Z,1,2");
  EXPECT_EQ(table->rows[1].text, "2025-01-01T00:00:00Z,3,4");
}

TEST(SunTable, TakesDefaultsForWhatARowLeavesEmpty) {
  sky::Observer defaults;
  defaults.height = Metres(1500.0);
  defaults.pressure_mbar = 850.0;
  const std::string text = "utc,lat,lon,height_m,temperature_c\n2025-01-01T00:00:00Z,1,2,,-5\n";
  const Result<SunTable> table = ParseSunTable(text, "points.csv", defaults);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->rows[0].observer.height.value(), 1500.0);
  EXPECT_EQ(table->rows[0].observer.pressure_mbar, 850.0);
  EXPECT_EQ(table->rows[0].observer.temperature_c, -5.0);
}

TEST(SunTable, MayEndInBlankLines) {
  const Result<SunTable> table = Parse("utc,lat,lon\n2025-01-01T00:00:00Z,1,2\n\r\n \t\n\n");
  ASSERT_TRUE(table) << table.error().Message();
  EXPECT_EQ(table->rows.size(), 1u);
}

TEST(SunTable, MayHaveNoRows) {
  const Result<SunTable> table = Parse("utc,lat,lon\n");
  ASSERT_TRUE(table);
  EXPECT_TRUE(table->rows.empty());
}

TEST(SunTable, NamesFileAndLineOfWhatIsWrong) {
  const std::string good = "utc,lat,lon\n2025-01-01T00:00:00Z,1,2\n";
  EXPECT_EQ(ErrorOf("").find("points.csv: is empty"), 0u);
  EXPECT_EQ(ErrorOf("\xEF\xBB\xBF\r\n\r\n").find("points.csv: is empty"), 0u);
  EXPECT_EQ(ErrorOf("utc,lat\n").find("points.csv:1: the column lon is missing"), 0u);
  EXPECT_EQ(ErrorOf("lat,lon\n").find("points.csv:1: the column utc is missing"), 0u);
  EXPECT_EQ(ErrorOf("utc,lat,lon,lat\n").find("points.csv:1: two columns are called lat"), 0u);
  EXPECT_EQ(ErrorOf(good + "2025-01-01T00:00:00Z,1\n").find("points.csv:3: has 2 fields"), 0u);
  EXPECT_EQ(ErrorOf(good + "2025-01-01T00:00:00,1,2\n").find("points.csv:3: time"), 0u);
  EXPECT_EQ(ErrorOf(good + "\n2025-01-01T00:00:00Z,1,2\n").find("points.csv:3: the line is blank"),
            0u);
  EXPECT_EQ(ErrorOf(good + " \r\n\n2025-01-01T00:00:00Z,1,2").find("points.csv:3: the line is bl"),
            0u);
  EXPECT_EQ(ErrorOf("\n" + good).find("points.csv:1: the line is blank"), 0u);
  EXPECT_EQ(ErrorOf(good + "2025-01-01T00:00:00Z,90.01,2\n").find("points.csv:3: lat"), 0u);
  EXPECT_EQ(ErrorOf(good + "2025-01-01T00:00:00Z,nan,2\n").find("points.csv:3: lat"), 0u);
  EXPECT_EQ(ErrorOf(good + "2025-01-01T00:00:00Z,1,1e400\n").find("points.csv:3: lon"), 0u);
  EXPECT_EQ(ErrorOf(good + "2025-01-01T00:00:00Z,1,\n").find("points.csv:3: lon"), 0u);
  EXPECT_EQ(ErrorOf(good + "2025-01-01T00:00:00Z,1,2x\n").find("points.csv:3: lon"), 0u);
  EXPECT_EQ(ErrorOf(good + "\"2025\n\n").find("points.csv:3: a quoted field is not closed"), 0u);
}

}  // namespace
}  // namespace pleinair::app
