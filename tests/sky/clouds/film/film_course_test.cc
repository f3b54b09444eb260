// The sun and the sky of films, relative to those of a clear sky.
#include "sky/clouds/film/film_course.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace pleinair::clouds {
namespace {

constexpr double kClearRatio = 5.0;
constexpr int kFrames = 100;

/// A film of 20 s. The functions give the transmittance of the clouds, the sky over the clear one
/// and the exposure, by the share of the film that has passed.
std::vector<FilmLight> Film(const std::function<double(double)>& sun, double sky,
                            const std::function<double(double)>& exposure) {
  std::vector<FilmLight> frames;
  frames.reserve(kFrames);
  for (int i = 0; i < kFrames; ++i) {
    const double share = i / (kFrames - 1.0), gain = exposure(share);
    frames.push_back({20.0 * share, gain * kClearRatio * sun(share), gain * sky});
  }
  return frames;
}
double Steady(double) { return 0.02; }
/// A cloud that leaves a tenth of the sun in the middle of the film.
double Cloud(double share) { return std::fabs(share - 0.5) < 0.2 ? 0.1 : 1.0; }

TEST(FilmCourse, IsFreeOfTheCamerasScale) {
  const FilmCourse course = MakeFilmCourse(Film(Cloud, 1.4, Steady), kClearRatio).value();
  EXPECT_FALSE(course.IsSteady());
  EXPECT_TRUE(course.SeesClearSun());
  ASSERT_EQ(course.sun.size(), static_cast<std::size_t>(kFrames));
  ASSERT_EQ(course.sky.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_NEAR(course.sun[i], Cloud(i / (kFrames - 1.0)), 1e-9);
    EXPECT_NEAR(course.sky[i], 1.4, 1e-9);
  }
}

// An automatic exposure multiplies sun and sky alike.
TEST(FilmCourse, IsFreeOfAnExposureThatFollows) {
  const auto follows = [](double share) { return Cloud(share) < 0.5 ? 0.09 : 0.02; };
  const FilmCourse course = MakeFilmCourse(Film(Cloud, 1.4, follows), kClearRatio).value();
  EXPECT_TRUE(course.sky.empty()) << "unknown";
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_NEAR(course.sun[i], Cloud(i / (kFrames - 1.0)), 1e-9);
  }
}

TEST(FilmCourse, TellsClearLightFromSteadyClouds) {
  const FilmCourse clear =
      MakeFilmCourse(Film([](double) { return 1.0; }, 1.0, Steady), kClearRatio).value();
  EXPECT_TRUE(clear.IsSteady());
  EXPECT_TRUE(clear.SeesClearSun());
  const FilmCourse thin =
      MakeFilmCourse(Film([](double) { return 0.3; }, 1.5, Steady), kClearRatio).value();
  EXPECT_TRUE(thin.IsSteady());
  EXPECT_FALSE(thin.SeesClearSun());
  EXPECT_NEAR(thin.top_ratio, 0.2, 1e-9);
  EXPECT_NEAR(thin.sun.front(), 0.2, 1e-9);
  const FilmCourse overcast =
      MakeFilmCourse(Film([](double) { return 0.0; }, 1.5, Steady), kClearRatio).value();
  EXPECT_TRUE(overcast.IsSteady());
  EXPECT_FALSE(overcast.SeesClearSun());
}

TEST(FilmCourse, RefusesFilmsThatShowTooLittle) {
  std::vector<FilmLight> frames = Film(Cloud, 1.4, Steady);
  frames.resize(9);
  EXPECT_THAT(MakeFilmCourse(frames, kClearRatio).error().Message(),
              ::testing::HasSubstr("9 frames"));
  frames = Film(Cloud, 1.4, Steady);
  for (FilmLight& frame : frames) frame.seconds *= 0.09;
  EXPECT_FALSE(MakeFilmCourse(frames, kClearRatio).has_value()) << "1.8 s";
  frames = Film(Cloud, 0.0, Steady);
  EXPECT_THAT(MakeFilmCourse(frames, kClearRatio).error().Message(),
              ::testing::HasSubstr("without skylight"));
}

}  // namespace
}  // namespace pleinair::clouds
