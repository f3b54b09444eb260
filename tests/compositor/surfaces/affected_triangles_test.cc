#include "compositor/surfaces/affected_triangles.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "compositor/surfaces/sun_facing_triangles.h"
#include "compositor/surfaces/visibility_buffer.h"

namespace pleinair::compositor {
namespace {

using ::testing::ElementsAre;

/// Four triangles at intervals of one metre along x, all facing up.
LitMesh Row() {
  LitMesh mesh;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto x = static_cast<float>(i);
    for (const auto& [dx, dy] : {std::pair{0.0F, 0.0F}, {0.5F, 0.0F}, {0.0F, 0.5F}}) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back({x + dx, dy, 0.0F});
      mesh.normals.push_back({0.0F, 0.0F, 1.0F});
      mesh.ambient_without.push_back({1000.0F, 1000.0F, 1000.0F});
      mesh.ambient_with.push_back(mesh.ambient_without.back());
    }
  }
  return mesh;
}

/// The same of a virtual object.
LitMesh ObjectRow() {
  LitMesh mesh = Row();
  mesh.ambient_without.clear();
  return mesh;
}

// A square of 1 m perpendicular to a sun overhead, from x = 0.9 m on.
const SunWindow kWindow{{1.0F, 0.0F, 0.0F, -0.9F}, {0.0F, 1.0F, 0.0F, 0.0F}, 1.0F, {0, 0, 1}};

constexpr glm::vec3 kSun(4000.0F, 3000.0F, 2000.0F);

TEST(AffectedTriangles, AreThoseInTheSunsWindowAndThoseWhoseSkyChanges) {
  LitMesh mesh = Row();
  mesh.ambient_with[3 * 3 + 1][2] = 990.0F;  // A corner of the last triangle, in blue alone.
  mesh.ambient_with[0][0] = 999.0F;          // Below the visible threshold.
  AffectedTriangles triangles(mesh);
  triangles.Sort(kWindow, {}, kSun);
  EXPECT_THAT(triangles.ends(), ElementsAre(3, 6, 6, 12));
  EXPECT_THAT(triangles.indices(), ElementsAre(3, 4, 5, 9, 10, 11, 0, 1, 2, 6, 7, 8));
}

TEST(AffectedTriangles, AreAllWithoutReductions) {
  LitMesh mesh = Row();
  mesh.ambient_with[3 * 3][0] = 900.0F;
  AffectedTriangles triangles(mesh);
  triangles.Sort(kWindow, {}, kSun, DrawReductions::None());
  EXPECT_THAT(triangles.ends(), ElementsAre(3, 12, 12, 12));
  triangles.Sort({}, {}, {}, DrawReductions::None());
  EXPECT_THAT(triangles.ends(), ElementsAre(0, 12, 12, 12)) << "without a sun";
}

TEST(AffectedTriangles, InTheirOwnShadeNeedNoShadowMaps) {
  LitMesh mesh = Row();
  mesh.ambient_with[4][0] = mesh.ambient_with[10][0] = 900.0F;
  for (auto& normal : mesh.normals) normal = {0.0F, 0.0F, -1.0F};
  AffectedTriangles triangles(mesh);
  triangles.Sort(kWindow, {}, kSun);
  EXPECT_THAT(triangles.ends(), ElementsAre(0, 0, 6, 12));
  triangles.Sort({}, {}, {});
  EXPECT_THAT(triangles.ends(), ElementsAre(0, 0, 6, 12)) << "without a sun";
}

TEST(AffectedTriangles, NeedNoShadowMapsWhereItIsKnownWhatPhantomsLeaveOfTheSun) {
  LitMesh mesh = Row();
  for (auto& light : mesh.ambient_with) light[0] = 900.0F;
  mesh.sunlight.to_sun = {0.0F, 0.0F, 1.0F};
  mesh.sunlight.by_triangle = {SunVisibility::kAll, SunVisibility::kNone, SunVisibility::kNone,
                               SunVisibility::kSome};
  AffectedTriangles triangles(mesh);
  triangles.Sort(kWindow, {}, kSun);
  EXPECT_THAT(triangles.ends(), ElementsAre(3, 6, 12, 12)) << "objects may shade the second";
  EXPECT_THAT(triangles.indices(), ElementsAre(3, 4, 5, 9, 10, 11, 0, 1, 2, 6, 7, 8));
  SunWindow later = kWindow;
  later.to_sun = {0.0F, 0.004F, 1.0F};
  triangles.Sort(later, {}, kSun);
  EXPECT_THAT(triangles.ends(), ElementsAre(3, 12, 12, 12)) << "the sun has moved on";
  mesh.sunlight.by_triangle.clear();
  triangles.SetLight(mesh);
  triangles.Sort(kWindow, {}, kSun);
  EXPECT_THAT(triangles.ends(), ElementsAre(3, 12, 12, 12)) << "not known of another light";
}

TEST(AffectedTriangles, KnowTheRatioWherePhantomsLeaveAllOfTheSunOrNone) {
  LitMesh mesh = Row();
  for (auto& light : mesh.ambient_with) light = {900.0F, 800.0F, 700.0F};
  mesh.sunlight.to_sun = {0.0F, 0.0F, 1.0F};
  mesh.sunlight.by_triangle = {SunVisibility::kAll, SunVisibility::kNone, SunVisibility::kNone,
                               SunVisibility::kSome};
  AffectedTriangles triangles(mesh);
  triangles.Sort(kWindow, {}, kSun);
  ASSERT_EQ(triangles.linear_ratios().size(), 2U) << "the first and the third";
  const auto& [lit, shaded] = std::pair(triangles.linear_ratios()[0], triangles.linear_ratios()[1]);
  EXPECT_NEAR(lit.channels[0].w, 4900.0 / 5000.0, 1e-6);
  EXPECT_NEAR(lit.channels[1].w, 3800.0 / 4000.0, 1e-6);
  EXPECT_NEAR(lit.channels[2].w, 2700.0 / 3000.0, 1e-6);
  EXPECT_NEAR(shaded.channels[0].w, 0.9, 1e-6);
  EXPECT_NEAR(shaded.channels[2].w, 0.7, 1e-6);
  // A change of 0.3, visible from the corner at (2.5, 0), four metres above the eye; the other two
  // corners are nearer.
  EXPECT_NEAR(triangles.MaxLinearChangeFarFrom({2.0F, 0.0F, -4.0F}), 0.3 * std::hypot(0.5, 4.0),
              1e-5);
}

TEST(AffectedTriangles, AreNotThoseWhoseChangeOfTheSkyTheSunOutshines) {
  LitMesh mesh = Row();
  for (auto& light : mesh.ambient_with) light = {995.0F, 995.0F, 995.0F};
  mesh.sunlight.to_sun = {0.0F, 0.0F, 1.0F};
  mesh.sunlight.by_triangle = {SunVisibility::kAll, SunVisibility::kNone, SunVisibility::kNone,
                               SunVisibility::kAll};
  AffectedTriangles triangles(mesh);
  triangles.Sort(kWindow, {}, kSun);  // 5 of 3,000 to 5,000, and 5 of 1,000.
  EXPECT_THAT(triangles.ends(), ElementsAre(3, 3, 6, 12));
  EXPECT_THAT(triangles.indices(), ElementsAre(3, 4, 5, 6, 7, 8, 0, 1, 2, 9, 10, 11));
  triangles.Sort(kWindow, {}, kSun, {.affected_triangles = false});
  EXPECT_THAT(triangles.ends(), ElementsAre(3, 3, 12, 12));
}

TEST(AffectedTriangles, AreAllThatTheSunReachesWhereItsWindowIsUnknown) {
  AffectedTriangles triangles(Row());
  triangles.Sort(SunWindow::Everywhere({0, 0, 1}), {}, kSun);
  EXPECT_THAT(triangles.ends(), ElementsAre(12, 12, 12, 12));
}

/// A triangle between two corners.
void IncludeBetween(glm::vec2 low, glm::vec2 high, SunFootprint* objects) {
  const std::array at{low, glm::vec2(high.x, low.y), high};
  constexpr std::array<std::uint32_t, 3> kIndices{0, 1, 2};
  objects->Include(at, kIndices);
}

TEST(AffectedTriangles, AreNotThoseBesideTheObjectsInTheSunsWindow) {
  AffectedTriangles triangles(Row());
  const auto sunlit = [&](float reach_m, glm::vec2 low, glm::vec2 high) {
    SunWindow window = kWindow;
    window.reach_m = reach_m;
    SunFootprint objects(window);
    IncludeBetween(low, high, &objects);
    triangles.Sort(window, objects, kSun);
    return triangles.ends()[AffectedTriangles::kSun] / 3;
  };
  // Only the second triangle is in the window: 0.1 to 0.6 along it, up to 0.5 across.
  EXPECT_EQ(sunlit(0.0F, {0.3F, 0.3F}, {0.4F, 0.35F}), 1);
  EXPECT_EQ(sunlit(0.0F, {0.8F, 0.1F}, {0.9F, 0.2F}), 0) << "beside it";
  EXPECT_EQ(sunlit(0.0F, {0.3F, 0.7F}, {0.4F, 0.9F}), 0) << "beyond it";
  EXPECT_EQ(sunlit(0.25F, {0.8F, 0.1F}, {0.9F, 0.2F}), 1) << "within reach of it";
  EXPECT_EQ(sunlit(0.0F, {-0.5F, -0.5F}, {1.5F, 1.5F}), 1) << "larger than the window";
}

TEST(AffectedTriangles, AreAllWhereAnObjectLiesNobodyKnowsWhere) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [low, high] : {std::pair{glm::vec2(nan), glm::vec2(nan)},
                                  {glm::vec2(nan, 0.0F), glm::vec2(0.1F)},
                                  {glm::vec2(0.0F), glm::vec2(0.1F, nan)}}) {
    SunFootprint objects(kWindow);
    EXPECT_FALSE(objects.Touches({0.5F, 0.5F}, {0.6F, 0.6F}));
    IncludeBetween(low, high, &objects);
    EXPECT_TRUE(objects.Touches({0.0F, 0.0F}, {0.01F, 0.01F}));
    EXPECT_TRUE(objects.Touches({0.99F, 0.99F}, {1.0F, 1.0F}));
  }
  SunFootprint objects(kWindow);
  IncludeBetween({0.3F, 0.3F}, {0.4F, 0.35F}, &objects);
  EXPECT_TRUE(objects.Touches({nan, nan}, {nan, nan}));
}

TEST(SunFacingTriangles, LeaveThoseTurnedAwayFromTheSunToTheEnd) {
  LitMesh mesh = ObjectRow();
  for (int i = 3; i < 6; ++i) mesh.normals[i] = {0.0F, 0.0F, -1.0F};
  mesh.normals[9] = {0.0F, 0.0F, -1.0F};  // One corner of the last: part of it may face the sun.
  SunFacingTriangles triangles(mesh);
  EXPECT_EQ(triangles.facing_end(), 12) << "not sorted yet";
  EXPECT_TRUE(triangles.Sort({0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(triangles.facing_end(), 9);
  EXPECT_THAT(triangles.indices(), ElementsAre(0, 1, 2, 6, 7, 8, 9, 10, 11, 3, 4, 5));
  EXPECT_TRUE(triangles.Sort({0.0F, 0.0F, -1.0F}));
  EXPECT_EQ(triangles.facing_end(), 6) << "the second and the last";
}

TEST(SunFacingTriangles, AreAllUntilTheyAreSortedAgain) {
  LitMesh mesh = ObjectRow();
  for (std::size_t i = 0; i < 3; ++i) mesh.normals[i] = {0.0F, 0.0F, -1.0F};
  SunFacingTriangles triangles(mesh);
  EXPECT_FALSE(triangles.IncludeAll());
  EXPECT_TRUE(triangles.Sort({0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(triangles.facing_end(), 9);
  EXPECT_TRUE(triangles.IncludeAll());
  EXPECT_EQ(triangles.facing_end(), 12);
  EXPECT_TRUE(triangles.Sort({0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(triangles.facing_end(), 9);
}

TEST(SunFacingTriangles, HoldWhileTheSunMovesLessThanTheirMargin) {
  LitMesh mesh = ObjectRow();
  mesh.normals[0] = mesh.normals[1] = mesh.normals[2] = {0.999F, 0.0F, -0.045F};
  SunFacingTriangles triangles(mesh);
  triangles.Sort({0.0F, 0.0F, 1.0F});
  EXPECT_EQ(triangles.facing_end(), 12) << "a sun 3° farther on reaches the first";
  EXPECT_FALSE(triangles.Sort({0.03F, 0.0F, 0.99955F}));
  EXPECT_TRUE(triangles.Sort({0.06F, 0.0F, 0.9982F}));
  EXPECT_TRUE(triangles.Sort({0.0F, 0.0F, 0.0F}));
  EXPECT_EQ(triangles.facing_end(), 0) << "without a sun";
}

TEST(SunFacingTriangles, HoldWhileNormalsTurnLessThanTheirMargin) {
  LitMesh mesh = ObjectRow();
  SunFacingTriangles triangles(mesh);
  triangles.Sort({0.0F, 0.0F, 1.0F});
  const int before = triangles.facing_end();
  const auto turned = [&](float x, float z) {
    mesh.normals[0] = mesh.normals[1] = mesh.normals[2] = {x, 0.0F, z};
    triangles.SetNormals(mesh);
    return triangles.Sort({0.0F, 0.0F, 1.0F});
  };
  EXPECT_TRUE(turned(1.0F, 0.0F));
  EXPECT_EQ(triangles.facing_end(), before) << "the margin";
  EXPECT_FALSE(turned(0.9996F, -0.03F));
  EXPECT_TRUE(turned(0.998F, -0.06F)) << "since it sorted";
  EXPECT_EQ(triangles.facing_end(), before - 3);
}

TEST(VisibilityBuffer, TellsPiecesThatDoNotHangTogetherApart) {
  LitMesh mesh = ObjectRow();
  mesh.indices = {0, 1, 2, 2, 1, 3, 6, 7, 8, 4, 8, 5};
  EXPECT_THAT(ComponentsOf(mesh, 7), ElementsAre(7, 7, 7, 7, 8, 8, 8, 8, 8, 9, 10, 11));
}

}  // namespace
}  // namespace pleinair::compositor
