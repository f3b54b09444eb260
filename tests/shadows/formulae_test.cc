#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gl/glsl_as_cpp.h"
#include "shadows/caster_edges.h"
#include "shadows/edge_map.h"
#include "shadows/light_window.h"

namespace pleinair::shadows {
namespace glsl {
using namespace glm;  // GLSL's built-in names.
#include "shadows/shaders/shadow_formulae.glsl"
}  // namespace glsl

namespace {

TEST(VogelDisc, SpreadsEvenlyOverTheDisc) {
  constexpr int kPoints = 48;
  glm::dvec2 mean(0.0), second(0.0);
  for (int i = 0; i < kPoints; ++i) {
    const glm::dvec2 p(glsl::VogelDisc(i, kPoints));
    EXPECT_LT(glm::length(p), 1.0);
    mean += p / static_cast<double>(kPoints);
    second += p * p / static_cast<double>(kPoints);
  }
  EXPECT_LT(glm::length(mean), 0.02);
  EXPECT_NEAR(second.x, 0.25, 0.01);  // Variance of a uniform disc: ρ²/4 per axis.
  EXPECT_NEAR(second.y, 0.25, 0.01);
}

TEST(ShadowBoxShares, AddUpToTheBoxWhereverItLies) {
  for (const float k : {0.5F, 1.3F, 2.5F}) {
    for (int step = 0; step < 8; ++step) {
      const float place = 0.13F * static_cast<float>(step);
      double sum = 0.0, mean = 0.0;
      for (int quad = -3; quad < 3; ++quad) {
        const float offset = 2.0F * static_cast<float>(quad) + 0.5F - place;
        const glm::vec2 shares = glsl::ShadowBoxShares(offset, k);
        sum += shares.x + shares.y;
        mean += offset * shares.x + (offset + 1.0F) * shares.y;
      }
      EXPECT_NEAR(sum, 2.0F * k, 1e-5);
      // Texels are weighted by overlap. Their mean equals the box's except for variation within a
      // texel.
      EXPECT_LT(std::abs(mean / sum), 0.13) << k << ' ' << place;
    }
  }
  // ±½: the bilinear filter.
  const glm::vec2 bilinear = glsl::ShadowBoxShares(-0.3F, 0.5F);
  EXPECT_NEAR(bilinear.x, 0.7F, 1e-6F);
  EXPECT_NEAR(bilinear.y, 0.3F, 1e-6F);
}

/// Area of a box beyond a line, by many points of it.
double AreaBeyond(const glm::dvec2& half_sides, const glm::dvec2& normal, double away) {
  constexpr int kSteps = 400;
  int beyond = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const glm::dvec2 at =
          (2.0 * (glm::dvec2(i, j) + 0.5) / static_cast<double>(kSteps) - 1.0) * half_sides;
      beyond += glm::dot(at, normal) > away ? 1 : 0;
    }
  }
  return static_cast<double>(beyond) / (kSteps * kSteps);
}

TEST(ShareBeyond, IsTheAreaOfABoxBeyondALine) {
  for (const glm::dvec2 half_sides : {glm::dvec2(0.5, 0.5), {0.5, 0.1}, {0.03, 0.4}}) {
    for (const double turn : {0.0, 0.3, 1.571, 2.2, 4.0}) {
      const glm::dvec2 normal(std::cos(turn), std::sin(turn));
      for (const double away : {-0.6, -0.2, 0.0, 0.05, 0.31, 0.8}) {
        EXPECT_NEAR(glsl::ShareBeyond(glm::vec2(half_sides), glm::vec3(normal, away)),
                    AreaBeyond(half_sides, normal, away), 0.005)
            << half_sides.x << ' ' << turn << ' ' << away;
      }
    }
  }
  EXPECT_EQ(glsl::ShareBeyond(glm::vec2(0.0F), glm::vec3(1, 0, -0.3F)), 1.0F) << "no area";
}

TEST(ShareBeyond, OfTwoLinesIsNoLessThanNoneAndNoMoreThanTheSmaller) {
  EXPECT_FLOAT_EQ(glsl::ShareBeyondBoth(0.3F, 0.4F, 1.0F), 0.3F) << "parallel";
  EXPECT_FLOAT_EQ(glsl::ShareBeyondBoth(0.3F, 0.4F, -1.0F), 0.0F) << "a bar between them";
  EXPECT_FLOAT_EQ(glsl::ShareBeyondBoth(0.3F, 0.4F, 0.0F), 0.12F) << "perpendicular";
}

TEST(EdgeLine, IsWhatTheEdgeMapPacks) {
  for (double turn = 0.1; const double distance : {0.0, 0.2, 0.5, 0.7071}) {
    turn += 1.3;
    const glm::dvec2 normal(std::cos(turn), std::sin(turn));
    const std::uint32_t packed = EdgeMap::Packed(normal, distance);
    EXPECT_NE(packed, 0U) << "no line";
    const glm::vec3 line = glsl::EdgeLine(packed);
    EXPECT_NEAR(line.x, normal.x, 6e-4);
    EXPECT_NEAR(line.y, normal.y, 6e-4);
    EXPECT_NEAR(line.z, distance, 5e-4);
  }
}

TEST(CasterEdge, IsPartOfTheOutlineBetweenASideInTheSunAndOneInTheShade) {
  const CasterEdge between{{}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  EXPECT_FALSE(between.IsOutline({0, 0.6, 0.8}));
  EXPECT_TRUE(between.IsOutline({0, -0.6, 0.8}));
  EXPECT_FALSE(between.IsOutline({0, -0.6, -0.8})) << "both face away";
  const CasterEdge border{{}, {1, 0, 0}, {0, 0, 1}, {}};
  EXPECT_TRUE(border.IsOutline({0, -0.6, 0.8}));
}

TEST(ShadowWidestKernel, IsTheOneThatWindowsLeaveRoomFor) {
  for (const int resolution : {16, 256, 1000, 1024, 2048, 8192}) {
    EXPECT_EQ(glsl::ShadowWidestKernel(static_cast<float>(resolution)), WidestKernel(resolution));
  }
}

// At a height of one metre the disc's radius is 4.65 mm. A blocker must reach a tenth of that; a
// wall's foot does not.
TEST(ShadowMinHeight, TellsBlockersFromAWallsFoot) {
  const float tan_radius = std::tan(glm::radians(0.2665F));
  EXPECT_LT(glsl::ShadowMinHeight(0.00465F, tan_radius), 0.11F);
  EXPECT_GT(glsl::ShadowMinHeight(0.00465F, tan_radius), 5.0F * 0.00465F);
  EXPECT_EQ(glsl::ShadowMinHeight(-0.01F, tan_radius), 0.0F);
}

// A sunlit wall beside the receiver: within a pixel its height rises by cot of the sun's zenith
// distance. That is less than 3 down to 18° and is not a blocker. A steeper rise is one.
TEST(ShadowMinHeight, OfWhatThePixelAloneCoversPassesOverALitWallsFoot) {
  const float tan_radius = std::tan(glm::radians(0.2665F));
  for (const float pixel_m : {0.001F, 0.02F}) {
    for (const float share : {0.1F, 0.5F, 1.0F}) {
      const float away_m = share * pixel_m;
      const float min_m = glsl::ShadowMinHeightSought(away_m, pixel_m, tan_radius);
      EXPECT_GT(min_m, 2.9F * away_m);
      EXPECT_LT(min_m, 3.1F * away_m);
    }
    // Beyond the pixel's footprint the usual disc criterion applies.
    EXPECT_EQ(glsl::ShadowMinHeightSought(pixel_m + 0.01F, pixel_m, tan_radius),
              glsl::ShadowMinHeight(pixel_m + 0.01F - pixel_m, tan_radius));
  }
}

// Level ground under a low sun.
TEST(ShadowFaces, FromSixHundredthsOfADegreeOn) {
  EXPECT_FALSE(glsl::ShadowFaces(std::sin(glm::radians(0.055F))));
  EXPECT_TRUE(glsl::ShadowFaces(std::sin(glm::radians(0.06F))));
}

TEST(ShadowPlaneFacing, IsTheGroundsOwnDownToASunOfThreeTenthsOfADegree) {
  for (const float elevation : {0.3F, 0.5F, 20.0F, 90.0F}) {
    const float facing = std::sin(glm::radians(elevation));
    EXPECT_EQ(glsl::ShadowPlaneFacing(facing), facing) << elevation;
  }
  EXPECT_GT(glsl::ShadowPlaneFacing(std::sin(glm::radians(0.25F))), std::sin(glm::radians(0.28F)));
}

TEST(ShadowRise, IsThePlanesOwnAndFromASunOfOneDegreeDownNoMore) {
  float most = 0.0F;
  for (int step = 0; step < 280; ++step) {
    const float elevation = 89.0F * std::pow(0.98F, static_cast<float>(step));
    const float facing = std::sin(glm::radians(elevation));
    const float slope = std::cos(glm::radians(elevation)) / facing;  // Texels per texel.
    const float rise = glsl::ShadowRise(slope, facing);
    EXPECT_LE(rise, slope * 1.0001F) << elevation;
    if (elevation > 1.15F) {
      EXPECT_FLOAT_EQ(rise, slope) << elevation;
    }
    most = std::max(most, rise);
  }
  EXPECT_NEAR(most, 50.0F, 0.5F);
}

TEST(NormalCdf, IsWithinThePublishedErrorOfItsFit) {
  for (int step = -600; step <= 600; ++step) {
    const double x = 0.01 * step;
    EXPECT_NEAR(glsl::NormalCdf(static_cast<float>(x)), 0.5 * std::erfc(-x / std::sqrt(2.0)),
                1.5e-4)
        << x;
  }
}

TEST(GaussianVisibility, IsOneOnALitSurface) {
  // The paper's 1 − Φ gives ½ here.
  EXPECT_NEAR(glsl::GaussianVisibility(0.3F, 0.3F, 1e-6F), 1.0F, 1e-6F);
  EXPECT_EQ(glsl::GaussianVisibility(0.2F, 0.3F, 1e-6F), 1.0F);
  EXPECT_NEAR(glsl::GaussianVisibility(0.5F, 0.3F, 1e-4F), 0.0F, 1e-6F);
}

// Depths 0 (a share p of the kernel) and 1; receiver at 1. Truth 1 − p.
TEST(MomentVisibility, OfTwoPlanesHasTheMeasuredErrors) {
  for (const float p : {0.1F, 0.5F, 0.9F}) {
    const float mean = 1.0F - p;
    const float variance = p * (1.0F - p);
    EXPECT_NEAR(glsl::VarianceVisibility(1.0F, mean, variance), 1.0F - p, 1e-6F);
  }
  // Penumbrae too dark: 0.739, 0.317, 0.003 in place of 0.9, 0.5, 0.1.
  EXPECT_NEAR(glsl::GaussianVisibility(1.0F, 0.9F, 0.09F), 0.739F, 1e-3F);
  EXPECT_NEAR(glsl::GaussianVisibility(1.0F, 0.5F, 0.25F), 0.317F, 1e-3F);
  EXPECT_NEAR(glsl::GaussianVisibility(1.0F, 0.1F, 0.09F), 0.003F, 1e-3F);
}

// Lauritzen's linear step removes all light below the amount and keeps full light.
TEST(ReduceBleeding, CutsTheTailAndKeepsFullLight) {
  EXPECT_EQ(glsl::ReduceBleeding(0.25F, 0.25F), 0.0F);
  EXPECT_EQ(glsl::ReduceBleeding(0.1F, 0.25F), 0.0F);
  EXPECT_EQ(glsl::ReduceBleeding(1.0F, 0.25F), 1.0F);
  EXPECT_NEAR(glsl::ReduceBleeding(0.625F, 0.25F), 0.5F, 1e-6F);
  EXPECT_EQ(glsl::ReduceBleeding(0.3F, 0.0F), 0.3F);
}

// A receiver at depth b beneath occluders at 0 and a in equal shares. The variance map leaks 1/(1 +
// ((2b − a)/a)²); the warp over the range [0, 3a] leaks almost nothing.
TEST(ShadowWarp, StopsTheLeakOfStackedOccluders) {
  const float a = 1.0F / 3.0F, b = 1.25F * a;
  const float mean = 0.5F * a, variance = 0.25F * a * a;
  EXPECT_NEAR(glsl::VarianceVisibility(b, mean, variance), 0.308F, 1e-3F);
  const glm::dvec2 top(glsl::ShadowWarp(-0.5F)), low(glsl::ShadowWarp(a - 0.5F));
  const glm::dvec2 receiver(glsl::ShadowWarp(b - 0.5F));
  const glm::dvec2 warped_mean = 0.5 * (top + low);
  const glm::dvec2 warped_variance = 0.25 * (top - low) * (top - low);
  const auto leak = [&](int i) {
    return glsl::VarianceVisibility(static_cast<float>(receiver[i]),
                                    static_cast<float>(warped_mean[i]),
                                    static_cast<float>(warped_variance[i]));
  };
  EXPECT_LT(std::min(leak(0), leak(1)), 2e-3F);
}

}  // namespace
}  // namespace pleinair::shadows
