// Tests the measures of `pleinair bench shadows` where the result is known.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "app/bench/shadow_metrics.h"
#include "app/bench/shadow_truth.h"
#include "shadows/bench/example_models.h"
#include "tests/source_tree.h"

namespace pleinair::app {
namespace {

using shadows::VisibilityPicture;

VisibilityPicture Row(const std::vector<float>& visibility) {
  const int width = static_cast<int>(visibility.size());
  VisibilityPicture picture{Image<float>(width, 1), Image<float>(width, 1)};
  for (int x = 0; x < width; ++x) {
    picture.visibility(x, 0) = visibility[x];
    picture.depth_m(x, 0) = 2.0F;
  }
  return picture;
}

TEST(ShadowErrors, AreThoseOfAPictureMadeByHand) {
  //                                 dark  dark  penumbra  lit
  const VisibilityPicture truth = Row({0.0F, 0.0F, 0.5F, 1.0F});
  const VisibilityPicture result = Row({0.2F, 0.0F, 0.1F, 0.9F});
  const ShadowErrors errors = CompareVisibility(result, truth);
  EXPECT_EQ(errors.pixels, 4);
  EXPECT_EQ(errors.penumbra_pixels, 1);
  EXPECT_EQ(errors.dark_pixels, 2);
  EXPECT_NEAR(errors.rmse, std::sqrt((0.04 + 0.16 + 0.01) / 4.0), 1e-6);
  EXPECT_NEAR(errors.penumbra_rmse, 0.4, 1e-6);
  EXPECT_NEAR(errors.bias, (0.2 - 0.4 - 0.1) / 4.0, 1e-6);
  EXPECT_NEAR(errors.leak_mean, 0.1, 1e-6);
  EXPECT_NEAR(errors.over_darkening, 0.1, 1e-6);
}

TEST(ShadowErrors, LeaveOutPixelsThatShowAnotherSurface) {
  const VisibilityPicture truth = Row({0.0F, 1.0F});
  VisibilityPicture result = Row({1.0F, 1.0F});
  result.depth_m(0, 0) = 2.1F;
  EXPECT_EQ(CompareVisibility(result, truth).rmse, 0.0);
  EXPECT_EQ(CompareVisibility(result, truth).pixels, 1);
}

TEST(ShadowErrors, LeaveOutPixelsThatAreNotToCount) {
  const VisibilityPicture truth = Row({0.0F, 0.0F}), result = Row({1.0F, 0.5F});
  Image<float> leaves(2, 1);
  leaves(0, 0) = 1.0F;
  leaves(1, 0) = 0.0F;
  const ShadowErrors errors = CompareVisibility(result, truth, &leaves);
  EXPECT_EQ(errors.pixels, 1);
  EXPECT_NEAR(errors.leak_mean, 0.5, 1e-6);
}

// Corrections of the circular segment's share: V(0.5) = 0.8045, V(0.8) = 0.9480. The penumbra grows
// by 9.3 mm per metre under a sun overhead.
TEST(StraightEdge, HasThePublishedShareAndTheSunsWidth) {
  const shadows::StraightEdge edge{{0.0, 0.0, 1.0}, 1.0, 1.0};
  const glm::dvec3 overhead(0.0, 0.0, 1.0);
  const double half = EdgeHalfWidth(edge, overhead);
  EXPECT_NEAR(2.0 * half, 0.0093, 2e-5);
  EXPECT_NEAR(StraightEdgeTruth(edge, overhead, 0.5 * half), 0.8045, 1e-4);
  EXPECT_NEAR(StraightEdgeTruth(edge, overhead, 0.8 * half), 0.9480, 1e-4);
  EXPECT_NEAR(StraightEdgeTruth(edge, overhead, -0.5 * half), 1.0 - 0.8045, 1e-4);
}

TEST(ShadowTruth, AgreesWithTheClosedFormUnderATiltedSun) {
  const shadows::BenchScene scene = shadows::PoleAndBoxScene(16.0 / 9.0);
  const auto truth = ShadowTruth::Create(scene, 256);
  ASSERT_TRUE(truth.has_value());
  int soft = 0;
  for (const shadows::StraightEdge& edge : scene.edges) {
    const double x = edge.middle.x - edge.middle.z * scene.to_sun.x / scene.to_sun.z;
    for (int i = -20; i <= 20; ++i) {
      const double y =
          EdgeShadowY(edge, scene.to_sun) + i / 16.0 * EdgeHalfWidth(edge, scene.to_sun);
      const double closed = StraightEdgeTruth(edge, scene.to_sun, y);
      EXPECT_NEAR(truth->At({x, y, 0.0}, {0, 0, 1}), closed, 0.02) << edge.middle.z << ' ' << i;
      soft += closed > 0.1 && closed < 0.9 ? 1 : 0;
    }
  }
  EXPECT_GT(soft, 60);
}

TEST(ShadowTruth, IsDarkBehindTheBoxAndLitOnItsTop) {
  const shadows::BenchScene scene = shadows::PoleAndBoxScene(16.0 / 9.0);
  const auto truth = ShadowTruth::Create(scene, 64);
  ASSERT_TRUE(truth.has_value());
  EXPECT_EQ(truth->At({-0.1, 0.35, 0.0}, {0, 0, 1}), 0.0);
  EXPECT_EQ(truth->At({-0.1, 0.0, 0.8}, {0, 0, 1}), 1.0);
  EXPECT_EQ(truth->At({-0.1, 0.3, 0.4}, {0, 1, 0}), 0.0) << "turned away from the sun";
}

TEST(ExampleModels, AreWhatTheToolWrites) {
  const auto models = shadows::TreeAndBody();
  ASSERT_EQ(models.size(), 2U);
  for (const shadows::ExampleModel& model : models) {
    std::ifstream file(tests::SourceTree() / "docs/examples/tree_and_body" / model.file);
    std::istringstream written(model.text);
    std::string there, here;
    int words = 0;
    while (written >> here) {
      ASSERT_TRUE(file >> there) << model.file << " ends at word " << words;
      // Another machine's sine may round the last digit differently.
      if (here != there) {
        ASSERT_NEAR(std::stod(here), std::stod(there), 1.5e-4) << model.file << " word " << words;
      }
      ++words;
    }
    EXPECT_FALSE(file >> there) << model.file << " has more";
    EXPECT_GT(words, 5000);
  }
}

}  // namespace
}  // namespace pleinair::app
