#include "shadows/shadow_maps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/shadows/shadow_scene.h"

namespace pleinair::shadows {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class ShadowMapsTest : public ShadowScene {
 protected:
  void SetUp() override {
    ShadowScene::SetUp();
    options_.resolutions = {256, 256, 256, 256};
    AddGround();
    AddBox({-0.2, -0.2, 0}, {0.2, 0.2, 0.5});
    focus_.Include({-0.2, -0.2, 0});
    focus_.Include({0.2, 0.2, 0.5});
  }
  // A camera 3 m away, looking at the origin, shifted sideways by `shift_m`.
  static View CameraView(double shift_m) {
    View view;
    const glm::dmat4 gl_view =
        glm::lookAt(glm::dvec3(shift_m, -2.5, 1.7), glm::dvec3(shift_m, 0, 0), glm::dvec3(0, 0, 1));
    view.camera_from_marker = glm::scale(glm::dmat4(1.0), glm::dvec3(1, -1, -1)) * gl_view;
    view.tan_left = view.tan_right = 0.55;
    view.tan_up = view.tan_down = 0.42;
    view.near_m = 1.0;
    view.far_m = 9.0;
    return view;
  }
  const glm::dvec3 sun_ = SunAt(200, 40);
  ShadowMapOptions options_;
  Box focus_;
};

TEST_F(ShadowMapsTest, AreRedrawnOnlyWhenSomethingMoved) {
  auto maps = ShadowMaps::Create(options_);
  ASSERT_TRUE(maps.has_value()) << maps.error().Message();
  std::vector<ShadowCaster> casters = Casters();
  EXPECT_EQ(*maps->UpdateForRegion(casters, AsDirection(sun_), focus_), 2);
  EXPECT_EQ(*maps->UpdateForRegion(casters, AsDirection(sun_), focus_), 0);
  EXPECT_EQ(*maps->UpdateForRegion(casters, AsDirection(SunAt(200.5, 40)), focus_), 2);
  // The finest map contains the whole box (Eq. 14): the wide map need not be redrawn when the box
  // turns.
  casters[1].marker_from_model = glm::rotate(glm::dmat4(1.0), 0.1, glm::dvec3(0, 0, 1));
  EXPECT_EQ(*maps->UpdateForRegion(casters, AsDirection(SunAt(200.5, 40)), focus_), 1);
  ++casters[0].revision;
  EXPECT_EQ(*maps->UpdateForRegion(casters, AsDirection(SunAt(200.5, 40)), focus_), 2);
}

TEST_F(ShadowMapsTest, FittedToTheViewFollowItInWholeTexels) {
  options_.partitions = 3;
  auto maps = ShadowMaps::Create(options_);
  ASSERT_TRUE(maps.has_value());
  const std::vector<ShadowCaster> casters = Casters();
  ASSERT_TRUE(maps->UpdateForView(casters, AsDirection(sun_), CameraView(0.0)).has_value());
  const ShadowUniforms first = maps->uniforms();
  ASSERT_TRUE(maps->UpdateForView(casters, AsDirection(sun_), CameraView(0.0371)).has_value());
  for (int i = 0; i < 3; ++i) {
    const ShadowSliceUniforms& a = first.slices[i];
    const ShadowSliceUniforms& b = maps->uniforms().slices[i];
    EXPECT_NEAR(a.size.x, b.size.x, 1e-6F);
    const float moved = a.u_from_marker.w - b.u_from_marker.w;
    EXPECT_NEAR(moved, std::round(moved), 2e-3F) << "slice " << i;
  }
}

// Mountains on the horizon must not reduce the nearest map's resolution.
TEST_F(ShadowMapsTest, FittedToTheViewKeepTheirTexelsInASceneOfKilometres) {
  options_.partitions = 4;
  auto maps = ShadowMaps::Create(options_);
  ASSERT_TRUE(maps.has_value());
  ASSERT_TRUE(maps->UpdateForView(Casters(), AsDirection(sun_), CameraView(0.0)).has_value());
  const glm::vec4 alone = maps->uniforms().slices[0].size;
  AddBox({-9000, 7000, 0}, {9000, 9000, 1500});
  ASSERT_TRUE(maps->UpdateForView(Casters(), AsDirection(sun_), CameraView(0.0)).has_value());
  const glm::vec4 with_mountains = maps->uniforms().slices[0].size;
  // A third of the visible extent, plus a step of 2^¼.
  EXPECT_LT(with_mountains.x, 1.6F * alone.x);
  EXPECT_LT(with_mountains.y, 1.6F * alone.y);
}

TEST_F(ShadowMapsTest, OfSeveralPartitionsAgreeWhereTheyMeet) {
  options_.partitions = 3;
  options_.resolutions = {1024, 1024, 1024, 1024};
  AddQuad({-0.6, -6, 1.0}, {1.2, 0, 0}, {0, 12, 0});  // A roof whose shadow crosses all slices.
  auto maps = ShadowMaps::Create(options_);
  ASSERT_TRUE(maps.has_value());
  ASSERT_TRUE(
      maps->UpdateForView(Casters(), AsDirection(SunAt(270, 50)), CameraView(0.0)).has_value());
  // A strip along the shadow's axis is dark from end to end in every map.
  const double offset = 1.0 / std::tan(50 * kRadiansPerDegree);
  const ProbePlane inside{{offset - 0.1, -1.5, 0}, {0.01, 0, 0}, {0, 0.01, 0}, 20, 500};
  const std::vector<float> dark = Visibility(*maps, inside);
  EXPECT_LT(*std::max_element(dark.begin(), dark.end()), 1e-6F);
  const ProbePlane outside{{offset + 0.65, -1.5, 0}, {0.01, 0, 0}, {0, 0.01, 0}, 20, 500};
  const std::vector<float> lit = Visibility(*maps, outside);
  EXPECT_EQ(*std::min_element(lit.begin(), lit.end()), 1.0F);
  // Along the edge the visibility is about ½. A jump at a seam must not exceed what the coarser
  // map's texel explains.
  const ProbePlane edge{{offset + 0.6 - 0.0005, -1.5, 0}, {0.001, 0, 0}, {0, 0.01, 0}, 1, 500};
  const std::vector<float> half = Visibility(*maps, edge);
  for (std::size_t i = 1; i < half.size(); ++i) EXPECT_NEAR(half[i], half[i - 1], 0.35F) << i;
}

TEST_F(ShadowMapsTest, LeaveWhatLiesOutsideTheWindowsLit) {
  auto maps = ShadowMaps::Create(options_);
  ASSERT_TRUE(maps.has_value());
  ASSERT_TRUE(maps->UpdateForRegion(Casters(), AsDirection(sun_), focus_).has_value());
  const ProbePlane far{{50, 50, 0}, {1, 0, 0}, {0, 1, 0}, 8, 8};
  for (const float v : Visibility(*maps, far)) EXPECT_EQ(v, 1.0F);
}

TEST_F(ShadowMapsTest, WithoutCastersLeaveAllLit) {
  auto maps = ShadowMaps::Create(options_);
  ASSERT_TRUE(maps.has_value());
  ASSERT_TRUE(maps->UpdateForRegion({}, AsDirection(sun_), focus_).has_value());
  const ProbePlane ground{{-1, -1, 0}, {0.1, 0, 0}, {0, 0.1, 0}, 20, 20};
  for (const float v : Visibility(*maps, ground)) EXPECT_EQ(v, 1.0F);
}

TEST_F(ShadowMapsTest, RefuseOptionsOutOfRange) {
  options_.partitions = 5;
  const auto five = ShadowMaps::Create(options_);
  ASSERT_FALSE(five.has_value());
  EXPECT_THAT(five.error().Message(), HasSubstr("1 to 4"));
  options_.partitions = 2;
  options_.resolutions[1] = 1000;
  const auto odd = ShadowMaps::Create(options_);
  ASSERT_FALSE(odd.has_value());
  EXPECT_THAT(odd.error().Message(), HasSubstr("power of two"));
  // Methods without a pyramid accept any size.
  options_.method = ShadowMethod::kGaussian;
  EXPECT_TRUE(ShadowMaps::Create(options_).has_value());
  options_.resolutions[1] = 9000;
  const auto large = ShadowMaps::Create(options_);
  ASSERT_FALSE(large.has_value());
  EXPECT_THAT(large.error().Message(), Not(HasSubstr("power of two")));
}

TEST_F(ShadowMapsTest, RefuseASunWithoutDirection) {
  auto maps = ShadowMaps::Create(options_);
  ASSERT_TRUE(maps.has_value());
  EXPECT_FALSE(maps->UpdateForRegion(Casters(), Direction<Marker>{}, focus_).has_value());
}

}  // namespace
}  // namespace pleinair::shadows
