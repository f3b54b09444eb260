// Tests that fits and derived values report correct covariances.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/srgb.h"
#include "tests/tracker/alignment/alignment_scene.h"
#include "tracker/pose/corner_covariance.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

TEST(CovarianceOfCorners, IsThatOfWhereAMotionTakesThem) {
  // Of one motion that alone is uncertain, by a little, the corners go as it moves their places.
  const auto pixel_of = [](Vec2 unit) {
    const Mat3 observed{{40, 7, 158, -5, 33, 121, 0.05, -0.02, 1}};
    return Apply(observed, unit);
  };
  const std::array<double, 8> motion{2e-6, -1e-6, 3e-6, 1e-6, 2e-6, -2e-6, 4e-6, -3e-6};
  std::array<double, 64> motions{};
  for (std::size_t i = 0; i < 64; ++i) motions[i] = motion[i / 8] * motion[i % 8];
  std::array<FittedCorner, 4> corners;
  std::array<double, 8> moved{};
  for (std::size_t i = 0; i < 4; ++i) {
    const double u = 0.8 * kSquareCorners[i].x, v = 0.6 * kSquareCorners[i].y;
    corners[i] = CornerAt({u, v}, pixel_of);
    const double depth = motion[6] * u + motion[7] * v;
    const Vec2 there{u + motion[0] + motion[1] * u + motion[2] * v - depth * u,
                     v + motion[3] + motion[4] * u + motion[5] * v - depth * v};
    const Vec2 by = pixel_of(there) - corners[i].pixel;
    moved[2 * i] = by.x;
    moved[2 * i + 1] = by.y;
  }
  const CornerCovariance covariance = CovarianceOfCorners(corners, motions, 0.003);
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) {
      const double expected = moved[i] * moved[j] + (i == j ? 0.003 * 0.003 : 0.0);
      EXPECT_NEAR(covariance[8 * i + j], expected, 1e-4 * std::sqrt(expected * expected + 1e-16));
    }
  }
}

/// Normalised estimation error squared per degree of freedom (8), mean over this number of images.
/// It is 1 for an exact covariance.
double MeanNees(double side_px, const RenderingOptions& rendering, int pictures,
                void (*spoil)(AlignmentScene*, std::uint32_t seed)) {
  AlignmentView view;
  view.side_px = side_px;
  ObservedPatch observed;
  BlockFit fit;
  double nees = 0.0;
  for (int k = 0; k < pictures; ++k) {
    RenderingOptions options = rendering;
    options.seed = static_cast<std::uint32_t>(k + 1);
    // A different position relative to the pixel grid in each image.
    view.centre_px = {158.0 + 0.13 * k, 121.0 - 0.29 * k};
    AlignmentScene scene = MakeScene(view, options);
    if (spoil != nullptr) spoil(&scene, options.seed);
    BlockFitState state = scene.Guess(0.4);
    EXPECT_TRUE(FitWhole(scene, &observed, &fit, &state));
    const std::array<Vec2, 4> found = scene.Corners(state);
    const auto pixel_of = [&](Vec2 unit_down) {
      return scene.lens->PixelOfUndistorted(Apply(Adjugate(state.modules_from_undistorted),
                                                  {24 + 20 * unit_down.x, 24 + 20 * unit_down.y}));
    };
    Eigen::Matrix<double, 8, 1> error;
    std::array<FittedCorner, 4> corners;
    for (int i = 0; i < 4; ++i) {
      error[2 * i] = found[i].x - scene.truth[i].x;
      error[2 * i + 1] = found[i].y - scene.truth[i].y;
      corners[i] = CornerAt({kSquareCorners[i].x, -kSquareCorners[i].y}, pixel_of);
    }
    const CornerCovariance of_corners = CovarianceOfCorners(corners, fit.MotionCovariance(), 0.0);
    const Eigen::Map<const Eigen::Matrix<double, 8, 8>> covariance(of_corners.data());
    nees += error.dot(covariance.ldlt().solve(error)) / 8.0 / pictures;
  }
  return nees;
}

TEST(BlockFit, StatesTheCovarianceOfItsCorners) {
  // Noise that the residuals do not contain (the raster's approximation, rounding to pixel values)
  // increases the mean. The covariance floor reduces it.
  for (const double side : {42.0, 120.0}) {
    const double nees = MeanNees(side, {.blur_px = 0.6, .noise_codes = 4.0, .light = {}}, 24, {});
    EXPECT_GT(nees, 0.4) << side;
    EXPECT_LT(nees, 1.7) << side;
  }
}

// What goes together in neighbouring pixels, a blur that is no Gaussian, noise as large as robust
// weights allow: with all residuals counted as independent the means were 12, 11, 2.2 and 78.
TEST(BlockFit, StatesACovarianceThatIsNotTooNarrowWhereTheModelIsWrong) {
  const auto noise = [](AlignmentScene*, std::uint32_t) {};
  const auto texture = [](AlignmentScene* scene, std::uint32_t seed) {
    constexpr int kGrain = 5;
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 12.0);
    std::vector<double> grain(100 * 100);
    for (double& value : grain) value = normal(random);
    for (int y = 0; y < scene->image.height(); ++y) {
      for (int x = 0; x < scene->image.width(); ++x) {
        const double code = scene->image(x, y) + grain[y / kGrain * 100 + x / kGrain];
        scene->image(x, y) = static_cast<std::uint8_t>(std::clamp(code, 0.0, 250.0));
      }
    }
  };
  const auto cover = [](AlignmentScene* scene, std::uint32_t seed) {
    std::mt19937 random(seed);
    for (int y = 0; y < scene->image.height(); ++y) {
      for (int x = 0; x < 140 + static_cast<int>(seed); ++x) {
        scene->image(x, y) = static_cast<std::uint8_t>(120 + random() % 16);
      }
    }
  };
  const auto motion = [](AlignmentScene* scene, std::uint32_t) {
    const GreyImage still = scene->image;
    for (int y = 0; y < still.height(); ++y) {
      for (int x = 3; x + 3 < still.width(); ++x) {
        double light = 0.0;
        for (int d = -3; d <= 3; ++d) light += LinearFromSrgb8()[still(x + d, y)] / 7.0;
        scene->image(x, y) = static_cast<std::uint8_t>(std::lround(255.0 * SrgbFromLinear(light)));
      }
    }
  };
  struct Case {
    const char* name;
    double noise_codes, most;
    void (*spoil)(AlignmentScene*, std::uint32_t);
  };
  for (const Case& c : {Case{"noise", 35.0, 2.2, noise}, Case{"texture", 2.0, 2.2, texture},
                        Case{"cover", 2.0, 1.5, cover}, Case{"motion", 2.0, 3.6, motion}}) {
    const double nees =
        MeanNees(120.0, {.blur_px = 0.6, .noise_codes = c.noise_codes, .light = {}}, 12, c.spoil);
    RecordProperty(c.name, std::to_string(nees));
    EXPECT_GT(nees, 0.15) << c.name;
    EXPECT_LT(nees, c.most) << c.name;
  }
}

}  // namespace
}  // namespace pleinair::tracker
