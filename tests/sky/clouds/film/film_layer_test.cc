// Layers that give the light of films.
#include "sky/clouds/film/film_layer.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/sky/clouds/film/made_film.h"

namespace pleinair::clouds {
namespace {

using testing::FilmLayerOfClouds;
using testing::MadeFilm;
using testing::SkyOfFilm;
using testing::SunAbove;

struct Case {
  const char* name;
  const char* layer;
  double elevation_deg, length_s;
  const char* kind;
};
class FilmLayerCase : public ::testing::TestWithParam<Case> {};

TEST_P(FilmLayerCase, GivesTheLightOfTheFilm) {
  const Case& one = GetParam();
  const FilmSky sky = SkyOfFilm(SunAbove(190.0, one.elevation_deg));
  const CloudLayer truth = ParseCloudLayer(one.layer).value();
  const MadeFilm film = FilmLayerOfClouds(truth, sky, one.length_s, 240, 0.02, 7);
  const FilmCourse course = MakeFilmCourse(film.frames, ClearSunOverSky(*sky.clear)).value();
  FilmLayerFacts facts;
  if (*one.kind != '\0') facts.kind = ParseCloudKind(one.kind).value();
  const FilmLayer found = FitFilmLayer(course, facts, sky);
  ASSERT_EQ(found.outcome, FilmLayer::Outcome::kPassing);
  // Against the truth without noise, by the layer as it would be read from a file.
  const CloudFields fields = MakeFields({found.layer});
  const CloudSky first(sky.clear, fields, sky.ground_albedo, 0.0);
  const double ratio = ClearSunOverSky(*sky.clear);
  const double clear_sky = Luminance(sky.clear->SkyHorizontalIrradiance());
  double squares = 0.0, mean = 0.0, sun_squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < film.truth.seconds.size(); i += 5) {
    const CloudSky at(first, film.truth.seconds[i]);
    const double skylight = Luminance(at.DomeIlluminance(32)) / clear_sky;
    const double wanted = ratio * film.truth.sun[i] + film.truth.sky[i];
    const double off = ratio * at.sun_transmittance() + skylight - wanted;
    squares += off * off;
    sun_squares += std::pow(at.sun_transmittance() - film.truth.sun[i], 2);
    mean += wanted;
    ++count;
  }
  mean /= count;
  const double rms = std::sqrt(squares / count) / mean;
  const double sun_rms = std::sqrt(sun_squares / count);
  RecordProperty("light_rms", std::to_string(rms));
  RecordProperty("sun_rms", std::to_string(sun_rms));
  EXPECT_LE(rms, 0.10);
  EXPECT_LE(sun_rms, 0.10);
  EXPECT_LE(found.errors.light, 0.10);
  EXPECT_EQ(found.layer.kind, truth.kind);
  EXPECT_LT(found.cover.low, found.cover.high);
}

INSTANTIATE_TEST_SUITE_P(
    Films, FilmLayerCase,
    ::testing::Values(
        Case{"Cumulus", "kind=cumulus,cover=0.4,wind_m_s=8,wind_from_deg=250,seed=911", 43.0, 120.0,
             ""},
        Case{"ManyCumulus", "kind=cumulus,cover=0.7,optical_depth=10,wind_m_s=6,seed=913", 60.0,
             600.0, ""},
        Case{"Altocumulus", "kind=altocumulus,cover=0.6,wind_m_s=15,wind_from_deg=300,seed=914",
             45.0, 120.0, "altocumulus"}),
    [](const auto& film) { return std::string(film.param.name); });

/// The same light in all frames: transmittance of the clouds, and their sky over the clear one.
FilmCourse SteadyCourse(const FilmSky& sky, double sun, double skylight) {
  const double ratio = ClearSunOverSky(*sky.clear);
  std::vector<FilmLight> frames;
  frames.reserve(50);
  for (int i = 0; i < 50; ++i) frames.push_back({0.2 * i, ratio * sun, skylight});
  return MakeFilmCourse(frames, ratio).value();
}

TEST(FilmLayer, FindsNoCloudsInClearLight) {
  const FilmSky sky = SkyOfFilm(SunAbove(190.0, 40.0));
  EXPECT_EQ(FitFilmLayer(SteadyCourse(sky, 1.0, 1.0), {}, sky).outcome,
            FilmLayer::Outcome::kNoClouds);
}

TEST(FilmLayer, FindsTheDepthOfAUniformLayer) {
  const FilmSky sky = SkyOfFilm(SunAbove(190.0, 40.0));
  const CloudLayer slab = ParseCloudLayer("kind=slab,optical_depth=1.2").value();
  const CloudSky under(sky.clear, MakeFields({slab}), sky.ground_albedo, 0.0);
  const double skylight =
      Luminance(under.SkyHorizontalIrradiance()) / Luminance(sky.clear->SkyHorizontalIrradiance());
  const FilmLayer found =
      FitFilmLayer(SteadyCourse(sky, under.sun_transmittance(), skylight), {}, sky);
  ASSERT_EQ(found.outcome, FilmLayer::Outcome::kUniform);
  EXPECT_EQ(found.layer.kind, CloudKind::kSlab);
  EXPECT_NEAR(found.layer.optical_depth, 1.2, 0.06);
  EXPECT_FALSE(found.is_opaque);
  const FilmLayer opaque = FitFilmLayer(SteadyCourse(sky, 0.0, 1.0), {}, sky);
  ASSERT_EQ(opaque.outcome, FilmLayer::Outcome::kUniform);
  EXPECT_TRUE(opaque.is_opaque);
  EXPECT_GT(opaque.optical_depth.low, 2.0);
}

}  // namespace
}  // namespace pleinair::clouds
