// Particles and textures of a flow.
#include "content/flow/particles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "content/flow/line_integral_convolution.h"
#include "tests/content/flow/made_fields.h"

namespace pleinair::content {
namespace {

TEST(Particles, AreTheSameForTheSameTimeWhateverWasShown) {
  const auto field = MakeSteady(Square(33, 1.0), SolidRotation);
  const ParticleOptions options{.count = 300, .life_s = 2.0, .trail_s = 0.3};
  auto first = Particles::Create(*field, options);
  const auto once = first->At(7.25);
  auto other =
      Particles::Create(*field, {.count = 300, .life_s = 2.0, .trail_s = 0.3, .threads = 1});
  for (const Seconds time : {3.0, 7.2, 7.21, 100.0, 6.9}) EXPECT_TRUE(other->At(time));
  const auto again = other->At(7.25);
  ASSERT_EQ(once->size(), again->size());
  for (std::size_t i = 0; i < once->size(); ++i) {
    EXPECT_EQ((*once)[i].points, (*again)[i].points);
  }
}

TEST(Particles, MoveWithTheFlowAndTrailBehind) {
  const auto field = MakeSteady(Square(33, 1.0), SolidRotation);
  auto particles = Particles::Create(*field, {.count = 200, .life_s = 3.0, .trail_s = 0.5});
  const auto trails = particles->At(5.0);
  int full = 0;
  for (const ParticleTrail& trail : *trails) {
    if (trail.age_s < 0.5 || trail.points.empty()) continue;
    ++full;
    EXPECT_EQ(trail.points.size(), 16U);
    const double radius = Norm(trail.points.front());
    EXPECT_NEAR(trail.speed_m_s, radius, 1e-3);
    // One radian per second; the trail ends at the last of 15 fixed times, at most 0.5 s ago.
    const Vec3 &head = trail.points.front(), &tail = trail.points.back();
    const double angle = std::atan2(tail.x * head.y - tail.y * head.x, Dot(head, tail));
    EXPECT_LE(angle, 0.5 + 1e-3);
    EXPECT_GE(angle, 0.5 - 0.5 / 15.0 - 1e-3);
  }
  EXPECT_GT(full, 80);
}

TEST(Particles, FollowTheTimesOfTheField) {
  // A wind that grows: 0.02 t to the right.
  const auto field = MakeField(
      Square(33, 10.0), {0.0, 1.0, 5.0, 20.0},
      [](const Vec3&, Seconds t) {
        return Vec3{0.02 * t, 0, 0};
      },
      Interpolation::kLinear);
  auto particles = Particles::Create(*field, {.count = 100, .life_s = 6.0, .trail_s = 0.5});
  for (const Seconds time : {8.0, 8.033, 8.066}) {
    const auto trails = particles->At(time);
    int alive = 0;
    for (const ParticleTrail& trail : *trails) {
      if (trail.points.empty()) continue;
      ++alive;
      EXPECT_NEAR(trail.speed_m_s, 0.02 * time, 1e-9);
    }
    EXPECT_GT(alive, 90);
  }
}

TEST(Particles, AreBornEvenly) {
  const Box box{{0.0, 0.0, 3.0}, {8.0, 8.0, 3.0}};
  std::vector<int> counts(64);
  for (std::uint64_t n = 0; n < 6400; ++n) {
    const Vec3 p = Birthplace(box, n);
    EXPECT_EQ(p.z, 3.0);
    ++counts.at(static_cast<std::size_t>(p.x) + 8 * static_cast<std::size_t>(p.y));
  }
  // Random births would spread by ±10.
  for (const int count : counts) EXPECT_NEAR(count, 100, 5);
}

TEST(LineIntegralConvolution, ByLevelsIsThatOfEachLine) {
  const auto field = MakeSteady(Square(65, 1.0), [](const Vec3& p) {
    constexpr double kPi = std::numbers::pi;
    return Vec3{-std::sin(kPi * p.x) * std::cos(kPi * p.y) - 0.2,
                std::cos(kPi * p.x) * std::sin(kPi * p.y), 0.0};
  });
  const ConvolutionOptions options{.width = 192, .height = 192};
  const auto fast = ConvolveByLevels(*field, 0.0, options);
  const auto exact = ConvolveSerially(*field, 0.0, options);
  double sum = 0.0, mean = 0.0, spread = 0.0;
  for (std::size_t i = 0; i < exact->size(); ++i) {
    const double off = static_cast<double>(fast->data()[i] - exact->data()[i]);
    sum += off * off;
    mean += static_cast<double>(exact->data()[i]) / static_cast<double>(exact->size());
  }
  for (std::size_t i = 0; i < exact->size(); ++i) {
    spread += std::pow(static_cast<double>(exact->data()[i]) - mean, 2.0);
  }
  const auto rms = [&](double squares) {
    return std::sqrt(squares / static_cast<double>(exact->size()));
  };
  EXPECT_LE(rms(sum), 1.0);
  EXPECT_GE(rms(spread), 5.0);
}

TEST(LineIntegralConvolution, IsSmoothAlongTheFlowAndDarkInWalls) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto field = MakeSteady(Square(65, 1.0), [&](const Vec3& p) {
    return p.y > 0.5 ? Vec3{nan, nan, 0.0} : Vec3{1.0, 0.0, 0.0};
  });
  const auto image = ConvolveByLevels(*field, 0.0, {.width = 128, .height = 128});
  double along = 0.0, across = 0.0;
  for (int y = 80; y < 120; ++y) {
    for (int x = 40; x < 90; ++x) {
      along += std::pow(static_cast<double>((*image)(x + 2, y) - (*image)(x, y)), 2.0);
      across += std::pow(static_cast<double>((*image)(x, y + 2) - (*image)(x, y)), 2.0);
    }
  }
  EXPECT_GT(across, 20.0 * along);
  EXPECT_EQ((*image)(64, 10), 0.0F);
  EXPECT_FALSE(ConvolveByLevels(*field, 0.0, {.width = 1, .height = 128}));
}

}  // namespace
}  // namespace pleinair::content
