#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/shadows/shadow_scene.h"

namespace pleinair::shadows {
namespace {

Box Around(const glm::dvec3& low, const glm::dvec3& high) {
  Box box;
  box.Include(low);
  box.Include(high);
  return box;
}

class SunShadow : public ShadowScene {};

/// Every method with its common options, and every filter of the sun's disc.
std::vector<ShadowMapOptions> EveryMethodAndFilter(int resolution) {
  std::vector<ShadowMapOptions> every;
  for (const ShadowMethodTraits& traits : ShadowMethods()) {
    every.push_back(CommonOptions(traits.method, resolution));
  }
  for (const SunDiscFilter filter : {SunDiscFilter::kBox, SunDiscFilter::kSample}) {
    every.push_back(CommonOptions(ShadowMethod::kSunDisc, resolution));
    every.back().sun_disc_filter = filter;
  }
  return every;
}

std::string NameOf(const ShadowMapOptions& options) {
  return std::string(TraitsOf(options.method).name) + ", filter " +
         std::to_string(static_cast<int>(options.sun_disc_filter));
}

TEST_F(SunShadow, LeavesALitPlaneFullyLitByEveryMethod) {
  AddGround();
  for (const double elevation : {0.5, 8.0, 45.0, 80.0}) {
    for (const ShadowMapOptions& options : EveryMethodAndFilter(256)) {
      const ShadowMaps maps =
          Region(SunAt(140, elevation), Around({-1, -1, 0}, {1, 1, 1}), options);
      const ProbePlane plane{{-3, -3, 0}, {0.0601, 0, 0}, {0, 0.0601, 0}, 100, 100};
      const std::vector<float> result = Visibility(maps, plane);
      const MapContent content = ContentOf(options);
      const float minimum = content == MapContent::kMoments         ? 0.98F
                            : content == MapContent::kWarpedMoments ? 0.95F
                                                                    : 0.9999F;
      EXPECT_GT(*std::min_element(result.begin(), result.end()), minimum)
          << NameOf(options) << " at " << elevation << " degrees";
    }
  }
}

// A board one metre up, far from its edges: points are dark over the kernel's whole reach.
TEST_F(SunShadow, IsDarkBeneathABoardByEveryMethod) {
  AddGround();
  AddQuad({-1.5, -1.5, 1.0}, {3, 0, 0}, {0, 3, 0});
  for (const ShadowMapOptions& options : EveryMethodAndFilter(256)) {
    const ShadowMaps maps = Region({0, 0, 1}, Around({-1.5, -1.5, 0}, {1.5, 1.5, 1}), options);
    const ProbePlane plane{{-0.5, -0.5, 0}, {0.02, 0, 0}, {0, 0.02, 0}, 50, 50};
    const std::vector<float> result = Visibility(maps, plane);
    EXPECT_LT(*std::max_element(result.begin(), result.end()), 1e-3F) << NameOf(options);
  }
}

// The methods differ only by kernel width: a box of n texels is n times as wide as one texel.
TEST_F(SunShadow, OfPercentageCloserFilteringFadesOverItsBox) {
  AddGround();
  AddQuad({-1.0, -1.0, 0.2}, {1, 0, 0}, {0, 2, 0});
  for (const auto& [method, side] :
       {std::pair{ShadowMethod::kPcf3, 3}, std::pair{ShadowMethod::kPcf5, 5},
        std::pair{ShadowMethod::kPcf7, 7}}) {
    ShadowMapOptions options = CommonOptions(method, 512);
    const ShadowMaps maps = Region({0, 0, 1}, Around({-1, -1, 0}, {1, 1, 0.2}), options);
    const double texel = maps.uniforms().slices[0].size.x;
    const ProbePlane line{{-0.5, 0.0, 0}, {0.001, 0, 0}, {0, 0.001, 0}, 1000, 1};
    double soft = 0.0;
    for (const float v : Visibility(maps, line)) soft += v > 0.0F && v < 1.0F ? 0.001 : 0.0;
    EXPECT_NEAR(soft / texel, side + 0.5, 0.6) << side;  // Between half a texel less and one more.
  }
}

TEST_F(SunShadow, HasNoAcneOnTheSunnySidesOfABox) {
  AddGround();
  AddBox({-0.2, -0.2, 0}, {0.2, 0.2, 0.5});
  const glm::dvec3 to_sun = SunAt(200, 30);  // The sunlit sides have low y and low x.
  const ShadowMaps maps = Region(to_sun, Around({-0.2, -0.2, 0}, {0.2, 0.2, 0.5}));
  // A millimetre from the foot, where the texels of ground and wall meet.
  const ProbePlane south{
      {-0.199, -0.2, 0.005}, {0.00199, 0, 0}, {0, 0, 0.00247}, 200, 200, {0, -1, 0}};
  const ProbePlane west{
      {-0.2, -0.199, 0.005}, {0, 0.00199, 0}, {0, 0, 0.00247}, 200, 200, {-1, 0, 0}};
  for (const ProbePlane& plane : {south, west}) {
    const std::vector<float> result = Visibility(maps, plane);
    EXPECT_EQ(*std::min_element(result.begin(), result.end()), 1.0F);
  }
  const ProbePlane north{
      {-0.199, 0.2, 0.005}, {0.00199, 0, 0}, {0, 0, 0.00247}, 200, 200, {0, 1, 0}};
  const std::vector<float> shaded = Visibility(maps, north);
  EXPECT_EQ(*std::max_element(shaded.begin(), shaded.end()), 0.0F);
}

TEST_F(SunShadow, BeginsWithinTwoMillimetresOfTheContact) {
  AddGround();
  AddBox({-0.2, -0.2, 0}, {0.2, 0.2, 0.5});
  for (const double elevation : {18.0, 43.0, 65.0}) {
    const glm::dvec3 to_sun = SunAt(180, elevation);  // The shadow points to +y.
    const ShadowMaps maps = Region(to_sun, Around({-0.2, -0.2, 0}, {0.2, 0.2, 0.5}));
    const ProbePlane plane{{-0.15, 0.2, 0}, {0.003, 0, 0}, {0, 0.0001, 0}, 100, 100};
    const std::vector<float> result = Visibility(maps, plane);
    for (int x = 0; x < plane.width; ++x) {
      int y = 0;
      while (y < plane.height && result[y * plane.width + x] > 0.5F) ++y;
      EXPECT_LT((plane.At(x, y) - plane.At(x, 0)).y, 0.002) << "elevation " << elevation;
    }
  }
}

TEST_F(SunShadow, EndsWhereTheGeometrySays) {
  AddGround();
  AddBox({-0.2, -0.2, 0}, {0.2, 0.2, 0.5});
  for (const double elevation : {18.0, 43.0, 65.0}) {
    const glm::dvec3 to_sun = SunAt(180, elevation);
    const ShadowMaps maps = Region(to_sun, Around({-0.2, -0.2, 0}, {0.2, 0.2, 0.5}));
    const double tip = 0.2 + 0.5 / std::tan(elevation * kRadiansPerDegree);
    const ProbePlane plane{{-0.1, tip - 0.03, 0}, {0.002, 0, 0}, {0, 0.0001, 0}, 100, 600};
    const std::vector<float> result = Visibility(maps, plane);
    double mean_edge = 0.0;
    for (int x = 0; x < plane.width; ++x) {
      int y = 0;
      while (y < plane.height && result[y * plane.width + x] < 0.5F) ++y;
      mean_edge += plane.At(x, y).y / plane.width;
    }
    EXPECT_NEAR(mean_edge, tip, 0.002) << "elevation " << elevation;
  }
}

// If a lower occluder covers the receiver, a higher one must not cause light to leak in.
TEST_F(SunShadow, DoesNotLeakBetweenTwoOccluders) {
  AddGround();
  AddQuad({-0.5, -0.5, 0.4}, {1, 0, 0}, {0, 1, 0});
  AddQuad({-1.0, -0.03, 2.0}, {2, 0, 0}, {0, 0.06, 0});
  const glm::dvec3 to_sun(0, 0, 1);
  const Box focus = Around({-0.6, -0.6, 0}, {0.6, 0.6, 0.5});
  const ProbePlane plane{{-0.3, -0.3, 0}, {0.003, 0, 0}, {0, 0.003, 0}, 200, 200};
  const std::vector<float> ours = Visibility(Region(to_sun, focus), plane);
  EXPECT_LT(*std::max_element(ours.begin(), ours.end()), 0.001F);
  ShadowMapOptions options;
  options.method = ShadowMethod::kVariance;
  const std::vector<float> variance = Visibility(Region(to_sun, focus, options), plane);
  EXPECT_GT(*std::max_element(variance.begin(), variance.end()), 0.3F)
      << "the scene no longer shows what it is for";
}

}  // namespace
}  // namespace pleinair::shadows
