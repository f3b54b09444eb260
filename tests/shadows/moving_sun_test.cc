// Tests shadows under a moving sun: steps, and the cross-fade between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shadows/fading_shadow_maps.h"
#include "shadows/sun_steps.h"
#include "tests/shadows/shadow_scene.h"

namespace pleinair::shadows {
namespace {

constexpr double kStep = 0.02 * kRadiansPerDegree;

// The sun's diurnal motion at latitude 50° north, after `hours`.
glm::dvec3 DailySun(double hours) {
  const double turn = 15.0 * kRadiansPerDegree * hours, latitude = 50.0 * kRadiansPerDegree;
  const double declination = 20.0 * kRadiansPerDegree;
  const glm::dvec3 equatorial(std::cos(declination) * std::sin(turn),
                              -std::cos(declination) * std::cos(turn), std::sin(declination));
  const double s = std::sin(latitude), c = std::cos(latitude);
  return {equatorial.x, equatorial.y * s + equatorial.z * c, -equatorial.y * c + equatorial.z * s};
}

TEST(SunSteps, HoldTheSunBetweenTwoOfThemAllDay) {
  SunSteps steps(kStep);
  glm::dvec3 from(0.0), to(0.0);
  int changes = 0;
  double last_share = 0.0;
  // A quarter of an hour in intervals of a twentieth of a second.
  for (int frame = 0; frame < 18000; ++frame) {
    const glm::dvec3 sun = DailySun(-3.0 + frame / 72000.0);
    const SunStep& step = steps.Follow(sun);
    ASSERT_GE(step.share, 0.0);
    ASSERT_LE(step.share, 1.0);
    // The cross-fade's mean position is the sun's.
    ASSERT_LT(glm::distance(sun, glm::mix(step.from, step.to, step.share)), 1e-3 * kStep) << frame;
    if (step.from != from) {
      // The next step becomes the previous one: its maps exist already.
      if (frame > 1) {
        ASSERT_EQ(step.from, to);
        ASSERT_GT(last_share, 0.98);
        ASSERT_LT(step.share, 0.02);
      }
      ++changes;
    }
    from = step.from;
    to = step.to;
    last_share = step.share;
  }
  // 3.75° along a circle of cos 20°.
  EXPECT_NEAR(changes, 3.75 * std::cos(20 * kRadiansPerDegree) / 0.02, 2);
}

TEST(SunSteps, BeginAnewWhereTheSunLeaps) {
  SunSteps steps(kStep);
  steps.Follow(DailySun(0.0));
  steps.Follow(DailySun(0.0005));
  const SunStep& step = steps.Follow(DailySun(0.1));
  EXPECT_EQ(step.from, DailySun(0.1));
  EXPECT_EQ(step.to, step.from);
  EXPECT_EQ(step.share, 0.0);
}

TEST(SunSteps, KeepTheStepBehindWhereTheSunTurnsBack) {
  SunSteps steps(kStep);
  for (int i = 0; i <= 20; ++i) steps.Follow(DailySun(1e-5 * i));
  for (int i = 20; i >= -20; --i) {
    const SunStep& step = steps.Follow(DailySun(1e-5 * i));
    EXPECT_NEAR(glm::distance(step.from, DailySun(0.0)), 0.0, 1e-15);  // Apart from rounding.
    EXPECT_NEAR(glm::distance(DailySun(1e-5 * i), glm::mix(step.from, step.to, step.share)), 0.0,
                1e-3 * kStep);
  }
}

class MovingSun : public ShadowScene {
 protected:
  void SetUp() override {
    ShadowScene::SetUp();
    AddQuad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
    AddQuad({-0.5, -0.5, 1.0}, {1, 0, 0}, {0, 1, 0});
    focus_.Include({-0.5, -0.5, 0});
    focus_.Include({0.5, 0.5, 1.0});
    options_.resolutions = {512, 256, 256, 256};
  }
  // Across an edge of the board's shadow.
  const ProbePlane line_{{-0.5, 0.1, 0}, {0.004, 0, 0}, {0, 0.03, 0}, 300, 20};
  ShadowMapOptions options_;
  Box focus_;
};

// If the maps are redrawn at every step, a shadow edge and its texel stairs jump by the sun's
// motion in a step. The cross-fade spreads that over many frames.
TEST_F(MovingSun, MovesShadowsWithoutAJump) {
  auto fading = FadingShadowMaps::Create(options_);
  auto stepped = ShadowMaps::Create(options_);
  ASSERT_TRUE(fading.has_value() && stepped.has_value());
  const auto casters = Casters();
  constexpr int kFramesAStep = 144;  // The sun at 30 frames per second.
  std::vector<float> last, last_stepped;
  float worst = 0.0F, worst_stepped = 0.0F, far = 0.0F;
  int redrawn = 0;
  for (int frame = 0; frame <= kFramesAStep; ++frame) {
    const double hours =
        -2.0 + 0.02 / 15.0 / std::cos(20 * kRadiansPerDegree) * frame / kFramesAStep;
    const auto drawn = fading->UpdateForRegion(casters, AsDirection(DailySun(hours)), focus_);
    ASSERT_TRUE(drawn.has_value());
    if (frame > 0) redrawn += *drawn;
    const std::vector<float> now = Visibility(*fading, line_);
    if (frame % kFramesAStep == 0) {
      ASSERT_TRUE(stepped->UpdateForRegion(casters, AsDirection(DailySun(hours)), focus_));
      const std::vector<float> exact = Visibility(*stepped, line_);
      for (std::size_t i = 0; i < exact.size() && frame > 0; ++i) {
        worst_stepped = std::max(worst_stepped, std::abs(exact[i] - last_stepped[i]));
      }
      // At the steps themselves only one set contributes.
      for (std::size_t i = 0; i < exact.size(); ++i)
        far = std::max(far, std::abs(exact[i] - now[i]));
      last_stepped = exact;
    }
    for (std::size_t i = 0; i < now.size() && frame > 0; ++i) {
      worst = std::max(worst, std::abs(now[i] - last[i]));
    }
    last = now;
  }
  RecordProperty("largest_change_a_frame", std::to_string(worst));
  RecordProperty("largest_jump_of_steps", std::to_string(worst_stepped));
  EXPECT_GT(worst_stepped, 0.02F) << "the scene no longer shows what it is for";
  EXPECT_LT(worst,
            1.2F * worst_stepped / static_cast<float>(kFramesAStep * FadingShadowMaps::kFadeShare));
  EXPECT_LT(worst, 1.0F / 255.0F);
  EXPECT_LT(far, 0.02F);
  // One step later: drawn once into both partitions; nothing else has moved.
  EXPECT_EQ(redrawn, 2);
}

}  // namespace
}  // namespace pleinair::shadows
