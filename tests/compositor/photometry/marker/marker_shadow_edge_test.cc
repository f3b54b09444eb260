#include "compositor/photometry/marker/marker_shadow_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace pleinair::compositor {
namespace {

constexpr double kSize = 0.4;
constexpr double kWhite = 0.80, kBlack = 0.04, kBlackShare = kBlack / (kWhite - kBlack);
// The sun is 4.7 times as strong as the sky, which is bluer.
const LinearRgb kSky{0.9, 1.0, 1.25}, kSun{4.9, 4.7, 4.3};
const LinearRgb kDepth{std::log1p(kSun.r / kSky.r / 2), std::log1p(kSun.g / kSky.g / 2),
                       std::log1p(kSun.b / kSky.b / 2)};

/// Pairs along a marker's edges with a share `sun` (0…1) of the sun, under veiling glare.
std::vector<MarkerPair> PairsIn(const std::function<double(Vec3)>& sun, double veil = 0.0) {
  std::vector<MarkerPair> pairs;
  constexpr int kASide = 40;
  for (int side = 0; side < 4; ++side) {
    for (int i = 0; i < kASide; ++i) {
      const double along = kSize * ((i + 0.5) / kASide - 0.5) * 0.8, out = kSize / 2;
      const Vec3 place = side % 2 == 0 ? Vec3{along, side == 0 ? out : -out, 0.0}
                                       : Vec3{side == 1 ? out : -out, along, 0.0};
      const LinearRgb light = kSky + kSun * sun(place);
      const LinearRgb step = light * (kWhite - kBlack);
      pairs.push_back({{place}, step, kBlack * (light.r + light.g + light.b) + 3 * veil});
    }
  }
  return pairs;
}

std::optional<MarkerShadowEdge> Find(const std::vector<MarkerPair>& pairs) {
  return FindMarkerShadowEdge(pairs, kDepth, kBlackShare);
}

/// Sun share across a shadow edge through `at`; the penumbra is `width_m` wide.
std::function<double(Vec3)> Edge(double angle, double at_m, double width_m) {
  return [=](Vec3 p) {
    const double across = p.x * std::cos(angle) + p.y * std::sin(angle) - at_m;
    const double t = std::clamp(2 * across / width_m, -1.0, 1.0);
    return 0.5 + (std::asin(t) + t * std::sqrt(1 - t * t)) / std::numbers::pi;
  };
}

TEST(MarkerShadowEdge, FindsHowDeepASharpShadowIs) {
  for (const double angle : {0.0, 0.4, 0.8, 2.0, 4.4}) {
    for (const double at : {-0.1, 0.0, 0.1}) {
      for (const double veil : {0.0, 0.3}) {
        const auto shadow = Find(PairsIn(Edge(angle, at, 0.01), veil));
        ASSERT_TRUE(shadow) << angle << " " << at;
        EXPECT_NEAR(shadow->contrast.r, std::log1p(kSun.r / kSky.r), 0.03);
        EXPECT_NEAR(shadow->contrast.g, std::log1p(kSun.g / kSky.g), 0.03);
        EXPECT_NEAR(shadow->contrast.b, std::log1p(kSun.b / kSky.b), 0.03);
        const Vec3 way = shadow->lit.xyz - shadow->shaded.xyz;
        EXPECT_GT(way.x * std::cos(angle) + way.y * std::sin(angle), 0.1);
      }
    }
  }
}

TEST(MarkerShadowEdge, LeavesHalfLightAlone) {
  // The penumbra of a distant roof or tree: at least half as wide as the marker, at any position.
  for (const double width : {0.5, 1.0, 1.5, 2.0, 4.0}) {
    for (int step = 0; step < 16; ++step) {
      const double angle = 0.1 * step;
      for (const double at : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
        const auto shadow = Find(PairsIn(Edge(angle, at, width * kSize)));
        // Where it covers only a corner, most pairs are fully lit or fully shaded.
        const double off =
            shadow ? std::fabs(shadow->contrast.g - std::log1p(kSun.g / kSky.g)) : 0.0;
        EXPECT_LT(off, 0.15) << width << " " << angle << " " << at;
      }
      if (width < 1.0) continue;
      EXPECT_FALSE(Find(PairsIn(Edge(angle, 0.0, width * kSize)))) << width << " " << angle;
    }
  }
  EXPECT_FALSE(Find(PairsIn([](Vec3 p) { return 0.5 + (p.x + p.y) / kSize / 2; })));
}

TEST(MarkerShadowEdge, TakesNothingThatLiesOnTheMarkerForAShadow) {
  const auto covered = [](double white, double black) {
    std::vector<MarkerPair> pairs = PairsIn([](Vec3) { return 1.0; });
    for (MarkerPair& pair : pairs) {
      if (pair.place.xyz.x > 0.0) continue;
      pair.step = pair.step * ((white - black) / (kWhite - kBlack));
      pair.black *= black / kBlack;
    }
    return pairs;
  };
  // Control: a cover with the contrast of a shadow is accepted.
  EXPECT_TRUE(Find(covered(kWhite / 4, kBlack / 4)));
  EXPECT_FALSE(Find(covered(kWhite / 4, kBlack)));        // Over the white alone,
  EXPECT_FALSE(Find(covered(kWhite / 4, 0.9 * kBlack)));  // with some of the black's light,
  EXPECT_FALSE(Find(covered(kWhite, 0.75 * kWhite)));     // and over the black.
}

TEST(MarkerShadowEdge, LooksForNoneWithoutASunOrWithFewPairs) {
  const std::vector<MarkerPair> pairs = PairsIn(Edge(0.0, 0.0, 0.01));
  ASSERT_TRUE(Find(pairs));
  EXPECT_FALSE(FindMarkerShadowEdge(pairs, {}, kBlackShare));
  EXPECT_FALSE(FindMarkerShadowEdge({}, kDepth, kBlackShare));
  EXPECT_FALSE(FindMarkerShadowEdge(std::span(pairs).first(20), kDepth, kBlackShare));
}

}  // namespace
}  // namespace pleinair::compositor
