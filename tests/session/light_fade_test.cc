#include "session/light_fade.h"

#include <gtest/gtest.h>

#include <vector>

namespace pleinair::session {
namespace {

using compositor::LitMesh;

std::vector<LitMesh> Lit(float value, std::uint64_t geometry = 7) {
  LitMesh mesh;
  mesh.geometry = geometry;
  mesh.positions = {{0, 0, 0}};
  mesh.ambient_with = {{value, 2 * value, 0}};
  return {mesh};
}

UtcTime At(double seconds) { return UtcTime(1'000'000'000).PlusSeconds(seconds); }

TEST(LightFade, GoesFromOneLightToTheNextWithoutAJump) {
  LightFade fade;
  EXPECT_EQ(fade.At(At(0), Lit(1)), nullptr);
  fade.Begin(Lit(1), Lit(3));
  ASSERT_TRUE(fade.on());
  EXPECT_EQ(fade.At(At(0.0), Lit(3))->at(0).ambient_with[0][0], 1.0F);
  EXPECT_NEAR(fade.At(At(0.1), Lit(3))->at(0).ambient_with[0][1], 3.0F, 1e-5);
  EXPECT_NEAR(fade.At(At(0.3), Lit(3))->at(0).ambient_with[0][0], 2.5F, 1e-5);
  EXPECT_EQ(fade.At(At(0.4), Lit(3)), nullptr);
  EXPECT_FALSE(fade.on());
}

TEST(LightFade, ANewLightBeginsWhereTheFadeIs) {
  LightFade fade;
  fade.Begin(Lit(1), Lit(3));
  fade.At(At(0.0), Lit(3));
  fade.At(At(0.2), Lit(3));
  fade.Begin(Lit(3), Lit(8));
  EXPECT_NEAR(fade.At(At(0.25), Lit(8))->at(0).ambient_with[0][0], 2.0F, 1e-5);
  EXPECT_NEAR(fade.At(At(0.45), Lit(8))->at(0).ambient_with[0][0], 5.0F, 1e-5);
}

TEST(LightFade, LightsBetweenTwoFramesBeginAtTheOneLastDrawn) {
  LightFade fade;
  fade.Begin(Lit(1), Lit(3));
  fade.Begin(Lit(3), Lit(5));
  EXPECT_EQ(fade.At(At(0.0), Lit(5))->at(0).ambient_with[0][0], 1.0F);
  EXPECT_NEAR(fade.At(At(0.2), Lit(5))->at(0).ambient_with[0][0], 3.0F, 1e-5);
}

TEST(LightFade, MixesTheLightInPlace) {
  const std::vector<LitMesh> next = Lit(3);
  LightFade fade;
  fade.Begin(Lit(1), next);
  const std::vector<LitMesh>* mixed = fade.At(At(0.0), next);
  const auto* positions = mixed->at(0).positions.data();
  const auto* light = mixed->at(0).ambient_with.data();
  ASSERT_EQ(fade.At(At(0.1), next), mixed);
  EXPECT_EQ(mixed->at(0).positions.data(), positions) << "surfaces are copied once a fade";
  EXPECT_EQ(mixed->at(0).ambient_with.data(), light);
}

TEST(LightFade, ReflectedSunlightThatOneLightLacksIsBlack) {
  LightFade fade;
  std::vector<LitMesh> next = Lit(3);
  next[0].sunlight.reflected_with = {{4, 0, 0}};
  fade.Begin(Lit(1), next);
  fade.At(At(0.0), next);
  EXPECT_NEAR(fade.At(At(0.1), next)->at(0).sunlight.reflected_with[0][0], 1.0F, 1e-5);
}

TEST(LightFade, OtherSurfacesAndARecordingThatBeginsAgainEndIt) {
  LightFade fade;
  fade.Begin(Lit(1, 7), Lit(3, 8));
  EXPECT_FALSE(fade.on());
  fade.Begin(Lit(1), Lit(3));
  fade.At(At(0.1), Lit(3));
  EXPECT_EQ(fade.At(At(0.0), Lit(3)), nullptr);
  EXPECT_FALSE(fade.on());
}

}  // namespace
}  // namespace pleinair::session
