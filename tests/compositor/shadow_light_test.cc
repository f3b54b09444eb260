// What the phantoms' own shadows say of the light, on pictures whose light is known.
#include <gtest/gtest.h>

#include <cmath>

#include "compositor/shadow_contrast.h"
#include "compositor/shadow_heading.h"
#include "tests/compositor/photographed_yard.h"

namespace pleinair::compositor {
namespace {

using testing::PhotographedYard;
constexpr Vec3 kUp{0, 0, 1};

class ShadowLight : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { yard_ = new PhotographedYard(); }
  static void TearDownTestSuite() {
    delete yard_;
    yard_ = nullptr;
  }

  static SurfaceSamples Look(const PhotographedYard::Light& light, int pictures = 2,
                             double exposure_step = 1.0) {
    SurfaceSamples samples(yard_->solver(), yard_->camera(), yard_->print());
    for (int i = 0; i < pictures; ++i) {
      const double gain = i == 0 ? 1.0 : exposure_step;
      RgbImage picture = yard_->Photograph(i, light);
      if (gain != 1.0) {
        for (std::size_t k = 0; k < picture.size(); ++k) {
          picture.data()[k] = Srgb8FromLinear(LinearFromSrgb8()[picture.data()[k]] * gain);
        }
      }
      samples.AddFrame(picture.view(), PhotographedYard::Pose(i), {gain, gain, gain});
    }
    return samples;
  }
  static SunSkyReading Read(const SurfaceSamples& samples) {
    return ReadSunAndSky(FindShadowEdges(yard_->solver(), samples, yard_->model(), Mat3{}));
  }

  static PhotographedYard* yard_;
};
PhotographedYard* ShadowLight::yard_ = nullptr;

void ExpectScale(const SunSkyReading& reading, LinearRgb truth) {
  ASSERT_EQ(reading.sun, SunSkyReading::Sun::kShines);
  EXPECT_NEAR(reading.sky_scale.r / truth.r, 1.0, 0.1);
  EXPECT_NEAR(reading.sky_scale.g / truth.g, 1.0, 0.1);
  EXPECT_NEAR(reading.sky_scale.b / truth.b, 1.0, 0.1);
  // It knows how well it knows.
  EXPECT_LT(std::fabs(std::log(reading.sky_scale.g / truth.g)), 3 * reading.log_uncertainty);
  EXPECT_LT(reading.log_uncertainty, 0.15);
}

TEST_F(ShadowLight, TellsHowStrongTheSkyIsBesideTheSun) {
  for (const double scale : {0.6, 1.0, 2.5}) {
    ExpectScale(Read(Look({.sky_scale = {scale, scale, scale}})), {scale, scale, scale});
  }
}

TEST_F(ShadowLight, TellsTheColourOfTheSkyBesideTheSuns) {
  ExpectScale(Read(Look({.sky_scale = {0.8, 1.0, 1.4}})), {0.8, 1.0, 1.4});
}

TEST_F(ShadowLight, SeesThatNoSunShines) {
  const SunSkyReading reading = Read(Look({.sky_scale = {3, 3, 3}, .sun_scale = 0.0}));
  EXPECT_EQ(reading.sun, SunSkyReading::Sun::kHidden);
  EXPECT_GE(reading.edges, 6);
}

TEST_F(ShadowLight, SeesAFaintSunThroughThickHaze) {
  const SunSkyReading reading = Read(Look({.sky_scale = {5, 5, 5}}));
  ASSERT_EQ(reading.sun, SunSkyReading::Sun::kShines);
  EXPECT_NEAR(reading.sky_scale.g, 5.0, 1.0);
}

TEST_F(ShadowLight, LeavesOutPlacesInTheShadowOfATreeThatNoPhantomStandsFor) {
  const auto tree = [](Vec3 p) {
    // Half the yard, in patches.
    return p.x < 0.0 && std::sin(9 * p.x) * std::sin(11 * p.y + 3 * p.z) > -0.6;
  };
  ExpectScale(Read(Look({.sky_scale = {1, 1, 1}, .shaded = tree}, 3)), {1, 1, 1});
}

TEST_F(ShadowLight, IsNotMisledByChangingExposure) {
  ExpectScale(Read(Look({}, 2, 0.7)), {1, 1, 1});
}

TEST_F(ShadowLight, SaysNothingWhereNoPhantomCastsAShadowInView) {
  const auto bare =
      LightSolver::Create({testing::Phantom(testing::Ground(5.0, {0.3F, 0.3F, 0.3F}))}, {});
  ASSERT_TRUE(bare);
  SurfaceSamples samples(**bare, yard_->camera(), yard_->print());
  samples.AddFrame(yard_->Photograph(0, {}).view(), PhotographedYard::Pose(0), {1, 1, 1});
  EXPECT_EQ(ReadSunAndSky(FindShadowEdges(**bare, samples, yard_->model(), Mat3{})).sun,
            SunSkyReading::Sun::kUnknown);
  EXPECT_FALSE(ReadHeading(**bare, samples, kUp, yard_->model().ToSun().xyz));
}

TEST_F(ShadowLight, FindsHowFarTheHeadingIsOff) {
  const SurfaceSamples samples = Look({});
  for (const double error_deg : {-7.0, -3.0, 0.0, 3.0}) {
    // The scene states a heading from which the sun stands so far off its true place.
    const Vec3 stated = Turned(yard_->model().ToSun().xyz, kUp, FromDegrees(error_deg));
    const auto heading = ReadHeading(yard_->solver(), samples, kUp, stated);
    ASSERT_TRUE(heading) << error_deg;
    EXPECT_NEAR(ToDegrees(heading->offset), -error_deg, 0.25);
    EXPECT_LT(ToDegrees(heading->uncertainty), 0.3);
  }
}

TEST_F(ShadowLight, BelievesTheStatedHeadingUnderAnOvercastSky) {
  const SurfaceSamples samples = Look({.sky_scale = {3, 3, 3}, .sun_scale = 0.0});
  EXPECT_FALSE(ReadHeading(yard_->solver(), samples, kUp, yard_->model().ToSun().xyz));
}

}  // namespace
}  // namespace pleinair::compositor
