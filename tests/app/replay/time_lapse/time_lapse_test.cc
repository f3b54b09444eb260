#include "app/replay/time_lapse/time_lapse.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>

#include "compositor/light/light_solver.h"
#include "compositor/photometry/sky_fit.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;
using compositor::testing::BoxModel;
using compositor::testing::Ground;
using compositor::testing::Object;
using compositor::testing::Phantom;

scene::PlaceTime Prague() {
  return {50.0875, 14.4213, 200.0, *UtcTime::Parse("2025-06-21T10:00:00Z")};
}

std::string Clock(const TimeLapseMoments& moments, std::size_t at) {
  return FormatLocal(moments.times[at], moments.clock);
}

TEST(TimeLapse, ShowsTheHoursOfAClockOnTheRecordingsDay) {
  const auto options = ParseTimeLapse("05:00..21:00+02:00", "10min");
  ASSERT_TRUE(options);
  const auto moments = MomentsOf(*options, Prague());
  ASSERT_TRUE(moments);
  ASSERT_EQ(moments->times.size(), 97U);
  EXPECT_EQ(Clock(*moments, 0), "2025-06-21T05:00:00+02:00");
  EXPECT_EQ(Clock(*moments, 96), "2025-06-21T21:00:00+02:00");
  // Without an offset the zone is the full hour nearest to solar time: Prague lies 14.4° east.
  const auto solar = MomentsOf(*ParseTimeLapse("05:00..05:20", "600s"), Prague());
  ASSERT_TRUE(solar);
  EXPECT_EQ(solar->times.size(), 3U);
  EXPECT_EQ(solar->times[0].ToString(), "2025-06-21T04:00:00Z");
  // East of the date line the local day begins before the UTC day.
  scene::PlaceTime tonga = Prague();
  tonga.longitude_deg = -175.2;
  const auto east = MomentsOf(*ParseTimeLapse("06:00..07:00+13:00", "1h"), tonga);
  ASSERT_TRUE(east);
  EXPECT_EQ(Clock(*east, 0), "2025-06-21T06:00:00+13:00");
}

TEST(TimeLapse, OfADayLastsFromBeforeSunriseUntilAfterSunset) {
  const auto moments = MomentsOf(*ParseTimeLapse("day", "15min"), Prague());
  ASSERT_TRUE(moments);
  // In Prague's summer time the sun rises at 4:52 and sets at 21:14.
  EXPECT_EQ(FormatLocal(moments->times.front(), {120}).substr(0, 16), "2025-06-21T04:22");
  EXPECT_LE(FormatLocal(moments->times.back(), {120}), "2025-06-21T21:46");
  EXPECT_GE(FormatLocal(moments->times.back(), {120}), "2025-06-21T21:29");
  scene::PlaceTime tromso = Prague();
  tromso.latitude_deg = 69.65;
  EXPECT_FALSE(MomentsOf(*ParseTimeLapse("day", "1h"), tromso));
  EXPECT_TRUE(MomentsOf(*ParseTimeLapse("00:00..24:00", "1h"), tromso));
}

TEST(TimeLapse, OfDatesHasOneTimeOfEachDay) {
  const auto moments =
      MomentsOf(*ParseTimeLapse("2025-04-15..2025-10-15@12:00+02:00", "7d"), Prague());
  ASSERT_TRUE(moments);
  EXPECT_TRUE(moments->over_dates);
  ASSERT_EQ(moments->times.size(), 27U);
  EXPECT_EQ(Clock(*moments, 0), "2025-04-15T12:00:00+02:00");
  EXPECT_EQ(Clock(*moments, 26), "2025-10-14T12:00:00+02:00");
  // Without a time of day it is that of the recording; across a leap day.
  const auto winter = MomentsOf(*ParseTimeLapse("2024-02-28..2024-03-01", std::nullopt), Prague());
  ASSERT_TRUE(winter);
  ASSERT_EQ(winter->times.size(), 3U);
  EXPECT_EQ(winter->times[1].ToString(), "2024-02-29T10:00:00Z");
  EXPECT_EQ(MomentsOf(*ParseTimeLapse("2025-06-01..2025-06-01", "2w"), Prague())->times.size(), 1U);
  EXPECT_FALSE(MomentsOf(*ParseTimeLapse("2020-01-01..2025-01-01", "1d"), Prague()));
  for (const char* dates :
       {"2025-04-15..2025-04-31", "2025-10-15..2025-04-15", "2025-04-15..2025-10-15@25:00",
        "2025-04-15..2025-10-15@24:00", "2025-04-15..2025-10-15@", "2025-04-15..2025-10-15 12:00",
        "25-04-15..25-10-15", "1800-01-01..1800-02-01", "2025-04-15..2025-10-15@12:00+99"}) {
    EXPECT_FALSE(ParseTimeLapse(dates, std::nullopt)) << dates;
  }
  for (const char* every : {"", "10min", "0d", "1.5d", "-1d", "367d", "d", "1e9w"}) {
    EXPECT_FALSE(ParseTimeLapse("2025-04-15..2025-10-15", every)) << every;
  }
}

TEST(TimeLapse, RefusesWhatIsNoPartOfADay) {
  for (const char* hours : {"", "5:00..21:00", "05:00-21:00", "05:00..", "05:00..24:01",
                            "21:00..05:00", "05:60..06:00", "05:00..21:00+99", "days"}) {
    EXPECT_FALSE(ParseTimeLapse(hours, "10min")) << hours;
  }
  for (const char* every :
       {"", "10", "min", "1d", "-5min", "0s", "nans", "25h", "10 min", "1e99h"}) {
    EXPECT_FALSE(ParseTimeLapse("05:00..21:00", every)) << every;
  }
  EXPECT_FALSE(MomentsOf(*ParseTimeLapse("00:00..24:00", "1s"), Prague())) << "too many pictures";
}

/// A white box of 40 cm on grey ground under Prague's midsummer sky, seen from above, north up.
class DayOfABox : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::vector<compositor::PlacedModel> placed{
        Phantom(Ground(1.5, {0.3F, 0.3F, 0.3F})),
        Object(BoxModel({-0.2, -0.2, 0.0}, {0.2, 0.2, 0.4}, {0.8F, 0.8F, 0.8F}))};
    auto solver = compositor::LightSolver::Create(placed, {.near_edge_m = 0.15});
    ASSERT_TRUE(solver);
    scene::SceneDescription scene;
    scene.place_time = Prague();
    session::LightingRequest request{scene.place_time.start,
                                     scene.place_time,
                                     {},
                                     {compositor::DescribedSky(scene)},
                                     *std::move(solver),
                                     {},
                                     {},
                                     {}};
    compositor::CoefficientOptions options;
    options.rays_per_vertex = 64;
    request.coefficients = std::make_shared<const compositor::DaylightCoefficients>(
        request.solver->Coefficients({0, 0, 1}, options, {}));
    auto day = DayRenderer::Create(camera_, placed, std::move(request), {});
    ASSERT_TRUE(day) << day.error().Message();
    day_ = *std::move(day);
    for (int hour = 0; hour < 24; ++hour) {
      const LinearRgb light = day_->LevelLight(At(hour));
      if (Luminance(light) > Luminance(brightest_)) brightest_ = light;
    }
  }

  static void TearDownTestSuite() { day_.reset(); }

  static UtcTime At(double hour_utc) {
    return UtcTime::Parse("2025-06-21T00:00:00Z")->PlusSeconds(3600.0 * hour_utc);
  }
  RgbImage Picture(double hour_utc,
                   const Transform<Camera, Marker>& camera_from_marker = camera_from_marker_) {
    const UtcTime time = At(hour_utc);
    auto picture = day_->Render(camera_from_marker, time,
                                ExposureScaleOfDay(day_->LevelLight(time), brightest_));
    EXPECT_TRUE(picture);
    return picture ? *std::move(picture) : RgbImage(96, 96, 3);
  }
  /// The pixel value at a point of the scene.
  std::array<double, 3> Code(
      const RgbImage& picture, Vec3 point,
      const Transform<Camera, Marker>& camera_from_marker = camera_from_marker_) const {
    const Vec2 px = ProjectToPixel(camera_, camera_from_marker * Point<Marker>{point});
    const auto* at =
        picture.view().row(static_cast<int>(std::lround(px.y))) + 3 * std::lround(px.x);
    return {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
  }

  static inline const CameraModel camera_{
      96, 96, 96, 96, 47.5, 47.5, DistortionModel::kBrownConrady, {}};
  /// 4 m above the origin, looking down.
  static inline const Transform<Camera, Marker> camera_from_marker_{{{1, 0, 0, 0, -1, 0, 0, 0, -1}},
                                                                    {0, 0, 4}};
  /// 4 m to the east and to the west, 20 cm high, looking at the box.
  static inline const Transform<Camera, Marker> from_east_{{{0, 1, 0, 0, 0, -1, -1, 0, 0}},
                                                           {0, 0.2, 4}};
  static inline const Transform<Camera, Marker> from_west_{{{0, -1, 0, 0, 0, -1, 1, 0, 0}},
                                                           {0, 0.2, 4}};
  static std::unique_ptr<DayRenderer> day_;
  static LinearRgb brightest_;
};
std::unique_ptr<DayRenderer> DayOfABox::day_;
LinearRgb DayOfABox::brightest_;

TEST_F(DayOfABox, TurnsTheShadowFromWestToEast) {
  const RgbImage morning = Picture(6.0), evening = Picture(16.0);
  const Vec3 west{-0.4, 0.0, 0.0}, east{0.4, 0.0, 0.0};
  EXPECT_LT(Code(morning, west)[1], 0.7 * Code(morning, east)[1]);
  EXPECT_LT(Code(evening, east)[1], 0.7 * Code(evening, west)[1]);
}

TEST_F(DayOfABox, IsWarmInTheSunAndBlueInTheShadeAtSunriseGreyAtNoonAndBlackAtNight) {
  const Vec3 top{0.0, 0.0, 0.4}, ground{1.0, -1.0, 0.0};
  const RgbImage noon = Picture(11.0), sunrise = Picture(3.3), night = Picture(-1.0);
  const auto grey = Code(noon, top);
  EXPECT_NEAR(grey[0], grey[2], 8.0);
  // White paper has 0.8 in linear light, pixel value 231, if nothing hides the sky.
  EXPECT_NEAR(grey[1], 231.0, 6.0);
  EXPECT_GT(Code(noon, ground)[1], 100.0);
  const auto dawn = Code(sunrise, top);
  EXPECT_LT(dawn[1], 0.9 * grey[1]);
  // The sun is in the northeast: it lights the east side; the west side receives skylight only.
  const auto east = Code(Picture(3.3, from_east_), {0.2, 0.0, 0.2}, from_east_);
  const auto west = Code(Picture(3.3, from_west_), {-0.2, 0.0, 0.2}, from_west_);
  EXPECT_GT(east[0], 1.3 * east[2]);
  EXPECT_GT(west[2], 1.1 * west[0]);
  for (const int channel : {0, 1, 2}) EXPECT_EQ(Code(night, top)[channel], 0.0);
}

TEST_F(DayOfABox, BecomesAVideoASheetAndAPartOfAPage) {
  std::string pattern = (fs::temp_directory_path() / "pleinair-day-XXXXXX").string();
  const fs::path folder = mkdtemp(pattern.data());
  EXPECT_EQ(*TimeLapseHtml(folder), "");
  const TimeLapseMoments moments{{At(6), At(9), At(12), At(15), At(18)}, {120}};
  const RendererAt always = [](UtcTime) -> Result<DayRenderer*> { return day_.get(); };
  const auto written = WriteTimeLapse(always, moments, camera_from_marker_, folder, true);
  ASSERT_TRUE(written) << written.error().Message();
  EXPECT_EQ(written->size(), 7U);
  for (const std::string& name : *written) EXPECT_GT(fs::file_size(folder / name), 100U) << name;
  const auto page = TimeLapseHtml(folder);
  ASSERT_TRUE(page);
  EXPECT_NE(page->find("data:video/mp4;base64,"), std::string::npos);
  EXPECT_NE(page->find("data:image/png;base64,"), std::string::npos);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace pleinair::app
