#include "scene/magnetic_declination.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "scene/scene_facts.h"

namespace pleinair::scene {
namespace {

using ::testing::HasSubstr;

// Of NOAA/NCEI's WMM2025 test values (public domain): decimal year, height in km, latitude,
// longitude, declination in degrees. From all its years and latitudes.
struct TestValue {
  double year, height_km, latitude_deg, longitude_deg, declination_deg;
};
constexpr TestValue kValues[] = {
    {2025.0, 48, 80, -96, -29.91},   {2025.0, 54, 82, 87, 54.89},   {2025.0, 65, 43, 93, 0.50},
    {2025.0, 51, -33, 109, -5.49},   {2025.0, 3, -50, -103, 27.96}, {2025.0, 18, 0, 21, 1.29},
    {2025.5, 50, -70, -133, 57.21},  {2025.5, 8, -66, 17, -33.14},  {2025.5, 44, 33, -118, 11.10},
    {2026.0, 83, 86, -46, -30.61},   {2026.0, 82, -64, 87, -81.74}, {2026.0, 34, -19, 43, -14.98},
    {2026.5, 12, -79, 115, -137.58}, {2026.5, 19, 29, 66, 2.24},    {2027.0, 67, 72, -115, 13.73},
    {2027.0, 54, 54, 178, 0.63},     {2027.0, 61, 59, -77, -16.48}, {2027.5, 8, 62, 53, 19.39},
    {2027.5, 73, -72, 95, -102.64},  {2027.5, 72, -87, 38, -65.44}, {2028.0, 75, 79, 125, -18.59},
    {2028.5, 68, -58, 156, 41.57},   {2028.5, 55, 86, 70, 67.64},   {2028.5, 11, 34, 0, 1.57},
    {2029.0, 58, 32, 19, 4.11},      {2029.0, 41, 42, -19, -4.13},  {2029.0, 49, -50, -179, 32.11},
    {2029.5, 31, 13, -132, 9.04},    {2029.5, 51, -76, 40, -56.34}};

UtcTime AtDecimalYear(double year) {
  const auto start = [](int each) {
    return UtcTime::Parse(std::to_string(each) + "-01-01T00:00:00Z")->nanoseconds_since_1970();
  };
  const int whole = static_cast<int>(year);
  const auto length = static_cast<double>(start(whole + 1) - start(whole));
  return UtcTime(start(whole) + static_cast<std::int64_t>((year - whole) * length));
}

TEST(MagneticDeclination, HasTheTestValuesOfItsModel) {
  for (const TestValue& each : kValues) {
    const auto found = MagneticDeclination(each.latitude_deg, each.longitude_deg,
                                           each.height_km * 1000.0, AtDecimalYear(each.year));
    ASSERT_TRUE(found) << found.error().Message();
    // They are rounded to a hundredth.
    EXPECT_NEAR(ToDegrees(*found), each.declination_deg, 0.0101)
        << each.latitude_deg << ' ' << each.longitude_deg;
  }
}

TEST(MagneticDeclination, IsRefusedWhereItIsNotKnown) {
  const UtcTime now = UtcTime::Parse("2026-06-01T00:00:00Z").value();
  const auto message = [](const Result<Radians>& found) {
    return found ? std::string() : found.error().Message();
  };
  EXPECT_THAT(
      message(MagneticDeclination(50, 14, 0, UtcTime::Parse("2024-11-01T00:00:00Z").value())),
      HasSubstr("WMM2025 holds from"));
  EXPECT_THAT(
      message(MagneticDeclination(50, 14, 0, UtcTime::Parse("2030-01-01T00:00:00Z").value())),
      HasSubstr("WMM2025 holds from"));
  // In the first and the last year that a time can have.
  for (const char* time : {"1678-01-01T00:00:00+01:00", "2261-06-01T00:00:00Z"}) {
    EXPECT_THAT(message(MagneticDeclination(50, 14, 0, UtcTime::Parse(time).value())),
                HasSubstr("WMM2025 holds from"));
  }
  EXPECT_EQ(message(MagneticDeclination(50, 14, 0, UtcTime::Parse("2024-11-14T00:00:00Z").value())),
            "");
  // The north magnetic pole of 2026 lies near 86° N, 139° E.
  EXPECT_THAT(message(MagneticDeclination(86, 139, 0, now)), HasSubstr("magnetic pole"));
  EXPECT_EQ(message(MagneticDeclination(-90, 0, 0, now)), "");
}

TEST(MagneticDeclination, TurnsAHeadingOfACompassToTrueNorth) {
  const std::string place = R"(
time = "2026-05-14T11:05:00Z"
[place]
latitude_deg = 43
longitude_deg = -110
height_m = 2000
[marker]
size_mm = 200
)";
  const auto heading_deg = [&](const std::string& line) -> Result<double> {
    PLEINAIR_ASSIGN_OR_RETURN(const SceneFacts facts, ParseSceneToml(place + line, "scene.toml"));
    PLEINAIR_ASSIGN_OR_RETURN(const SceneDescription scene, CompleteScene(facts, "scene.toml"));
    return ToDegrees(scene.marker.heading);
  };
  const auto by_compass = heading_deg("heading_magnetic_deg = 100\n");
  ASSERT_TRUE(by_compass) << by_compass.error().Message();
  const double declination_deg = ToDegrees(
      MagneticDeclination(43, -110, 2000, UtcTime::Parse("2026-05-14T11:05:00Z").value()).value());
  EXPECT_GT(declination_deg, 5.0);  // Wyoming's compasses point east of north.
  EXPECT_NEAR(*by_compass, 100 + declination_deg, 1e-9);
  const auto both = heading_deg("heading_magnetic_deg = 100\nheading_deg = 110\n");
  ASSERT_FALSE(both);
  EXPECT_THAT(both.error().Message(), HasSubstr("both heading_deg and heading_magnetic_deg"));
  const auto far = heading_deg("heading_magnetic_deg = 1000\n");
  ASSERT_FALSE(far);
  EXPECT_THAT(far.error().Message(), HasSubstr("-360 to 360"));
}

}  // namespace
}  // namespace pleinair::scene
