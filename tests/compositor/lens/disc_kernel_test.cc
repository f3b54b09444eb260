#include "compositor/lens/disc_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "compositor/lens/disc_scatter.h"

namespace pleinair::compositor {
namespace {

struct Moments {
  double sum = 0.0, mean_x = 0.0, mean_y = 0.0, variance_x = 0.0, variance_y = 0.0;
};

Moments MomentsOf(const DiscKernel& kernel) {
  Moments moments;
  for (const DiscKernel::Row& row : kernel.rows) {
    double weight = 0.0;
    int step = row.first;
    for (int x = -kernel.reach_px; x <= kernel.reach_px; ++x) {
      while (step < row.first + row.count && kernel.steps[static_cast<std::size_t>(step)].x <= x) {
        weight += kernel.steps[static_cast<std::size_t>(step++)].rise;
      }
      moments.sum += weight;
      moments.mean_x += weight * x;
      moments.mean_y += weight * row.y;
      moments.variance_x += weight * x * x;
      moments.variance_y += weight * row.y * row.y;
    }
  }
  return moments;
}

TEST(DiscKernels, HaveTheWeightAndTheWidthOfADisc) {
  DiscKernels kernels{LensStop{}};
  for (const double circle : {0.0, 0.5, 1.0, 2.0, 3.125, 7.875, 8.25, 20.0, 60.5, 128.0}) {
    const int index = DiscKernels::IndexOf(circle, {});
    kernels.Prepare(index);
    const Moments moments = MomentsOf(kernels.Of(index));
    EXPECT_NEAR(moments.sum, 1.0, 1e-5) << circle;
    EXPECT_NEAR(moments.mean_x, 0.0, 1e-4) << circle;
    EXPECT_NEAR(moments.mean_y, 0.0, 1e-4) << circle;
    if (circle <= 2.0) {
      // An edge between two pixels leaves d / (3π) in the next one: the mean of max(x, 0).
      EXPECT_NEAR(0.5 * moments.variance_x, circle / (3 * std::numbers::pi), 1e-3) << circle;
    } else {
      // That of a disc, d²/16, and of the pixels: of a tent up to 8 pixels, else of a box.
      const double expected = circle * circle / 16 + (circle <= 8.0 ? 1.0 / 6 : 1.0 / 12);
      EXPECT_NEAR(moments.variance_x, expected, 0.01 * expected) << circle;
    }
    EXPECT_NEAR(moments.variance_y, moments.variance_x, 0.007 * moments.variance_x + 1e-6)
        << circle;
  }
}

TEST(DiscKernels, TurnWithTheStopAndPointTheOtherWayBeforeTheFocus) {
  DiscKernels kernels{LensStop{3, 0.0}};  // A corner to the right.
  const auto prepared = [&](double circle) {
    const int index = DiscKernels::IndexOf(circle, {});
    kernels.Prepare(index);
    return kernels.Of(index);
  };
  const auto skew = [](const DiscKernel& kernel) {
    double first = 1e9, last = -1e9;
    for (const DiscKernel::Step& step : kernel.steps) {
      first = std::fmin(first, step.x);
      last = std::fmax(last, step.x - 1);
    }
    return first + last;
  };
  EXPECT_GT(skew(prepared(24.0)), 4.0);
  EXPECT_LT(skew(prepared(-24.0)), -4.0);
}

TEST(DiscKernels, LeaveThePartOfAPixelInIt) {
  DiscKernels kernels{LensStop{}};
  const int left = DiscKernels::IndexOf(1.0, {-1, 0, false});
  kernels.Prepare(left);
  EXPECT_LT(MomentsOf(kernels.Of(left)).mean_x, -0.2);
  EXPECT_EQ(DiscKernels::IndexOf(0.2, {-1, 0, false}), DiscKernels::IndexOf(0.0, {}));
  EXPECT_EQ(DiscKernels::IndexOf(30.0, {-1, 0, false}), DiscKernels::IndexOf(30.0, {}));
}

TEST(BlockLayers, SumPiecesAsTheirKernelsSay) {
  DiscKernels kernels{LensStop{}};
  const auto piece = [&](int x, int y, double circle) {
    SurfacePiece made{};
    made.values[0] = 2.0F;
    made.values[7] = 0.5F;
    made.x = static_cast<std::int16_t>(x);
    made.y = static_cast<std::int16_t>(y);
    made.kernel = static_cast<std::int16_t>(DiscKernels::IndexOf(circle, {}));
    made.layer = static_cast<std::int16_t>(LayerOf(circle));
    kernels.Prepare(made.kernel);
    return made;
  };
  const BlockLayers block({{piece(30, 31, 9.0), piece(40, 31, 0.0)}}, kernels);
  ASSERT_EQ(block.layers().size(), 2U);
  EXPECT_LT(block.layers()[0], block.layers()[1]);
  double sum = 0.0, occluders = 0.0;
  for (int y = 0; y < BlockLayers::kSide_px; ++y) {
    for (int x = 0; x < BlockLayers::kSide_px; ++x) {
      sum += block.At(block.layers()[1], x, y)[0];
      occluders += block.At(block.layers()[1], x, y)[7];
    }
  }
  EXPECT_NEAR(sum, 2.0, 1e-4);
  EXPECT_NEAR(occluders, 0.5, 1e-4);
  EXPECT_NEAR(block.At(block.layers()[1], 30, 31)[0], 2.0 / (std::numbers::pi * 4.5 * 4.5), 1e-4);
  EXPECT_NEAR(block.At(block.layers()[0], 40, 31)[0], 2.0, 1e-6);
  // A piece beside the block: what reaches it is the same as within.
  const BlockLayers beside({{piece(-3, 20, 9.0), piece(30, 30, 9.0)}}, kernels);
  const int layer = beside.layers().front();
  for (int x = 0; x < 6; ++x) {
    EXPECT_NEAR(beside.At(layer, x, 20)[0], beside.At(layer, x + 33, 30)[0], 1e-6) << x;
  }
}

TEST(LayerOf, GrowsFromNearToFar) {
  EXPECT_EQ(LayerOf(0.0), kLensLayers / 2);
  int last = -1;
  for (int step = -1280; step <= 1280; ++step) {
    const int layer = LayerOf(0.1 * step);
    EXPECT_GE(layer, last);
    EXPECT_LE(layer - last, last < 0 ? kLensLayers : 1);
    last = layer;
  }
  EXPECT_LT(last, kLensLayers);
}

TEST(LayerOf, BeginsAtItsFirstCircle) {
  for (int layer = 1; layer < kLensLayers; ++layer) {
    const double first = FirstCircle_px(layer);
    EXPECT_EQ(LayerOf(first + 1e-6), layer) << first;
    EXPECT_EQ(LayerOf(first - 1e-6), layer - 1) << first;
  }
}

}  // namespace
}  // namespace pleinair::compositor
