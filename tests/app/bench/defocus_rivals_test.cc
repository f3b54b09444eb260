// The paper's layers against its formulas.
#include "app/bench/defocus_rivals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include "app/bench/bench_composer.h"

namespace pleinair::app {
namespace {

TEST(GaussianLayers, HaveTheDeviationsOfTheCascade) {
  constexpr std::array kSigmas{1.0,       2.2360680, 3.7416574,  5.4772256,
                               7.4161985, 9.5393920, 11.8321596, 14.2828569};
  for (std::size_t n = 0; n < kSigmas.size(); ++n) {
    EXPECT_NEAR(SigmaOfLayer(static_cast<int>(n) + 1), kSigmas[n], 1e-6);
  }
}

TEST(GaussianLayers, CoverEveryDepthWhole) {
  const CameraModel camera = BenchCamera(320, 240);
  const compositor::ThinLens lens{30.0 / camera.fx, 0.25};
  const MattingFunctions matting(-12.0, 7.0, lens, camera.fx);
  EXPECT_GE(matting.layers(), 5);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> dioptres(0.001, 2.0);
  for (int i = 0; i < 10'000; ++i) {
    const double distance_m = 1.0 / dioptres(random);
    for (const bool is_peeled : {false, true}) {
      double largest = 0.0;
      for (int k = 0; k < matting.layers(); ++k) {
        const double weight = matting.Weight(k, distance_m, is_peeled);
        EXPECT_GE(weight, 0.0);
        largest = std::max(largest, weight);
      }
      EXPECT_EQ(largest, 1.0) << distance_m;
    }
  }
}

TEST(GaussianLayers, KeepLightAndWhatIsInFocus) {
  const CameraModel camera = BenchCamera(160, 120);
  const DefocusScene scene = MakeDefocusScene("fence", camera);
  const PeeledBoards seen(scene, camera.width, camera.height);
  const GaussianLayers drawn = DrawGaussianLayers(scene, seen, true);
  EXPECT_GE(drawn.layers, 3);
  double sum = 0.0;
  for (std::size_t i = 0; i < drawn.light.size(); ++i) sum += drawn.light.data()[i];
  EXPECT_GT(sum, 0.0);
  // Above and below the bars nothing is lit; the wall is in focus, and dimmed by the bars alone.
  EXPECT_NEAR(drawn.light(2, 2), 0.0, 1e-3);
  const Image<float> gathered = DrawGathered(scene, seen);
  EXPECT_NEAR(gathered(150, 60), 0.0, 1e-3);
}

}  // namespace
}  // namespace pleinair::app
