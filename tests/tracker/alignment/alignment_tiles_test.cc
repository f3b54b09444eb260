// Compares sums over tiles on every instruction set with their scalar reference and with plain
// sums.

#include <gtest/gtest.h>

#include <hwy/highway.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/tracker/alignment/alignment_scene.h"
#include "tests/tracker/surf/on_every_target.h"
#include "tracker/alignment/block_sums.h"

namespace pleinair::tracker {
namespace {

struct Data {
  AlignmentScene scene;
  ObservedPatch observed;
  PlaneMap map;
  PredictedImage image;
  std::vector<RowRange> ranges;
  std::vector<BlockLight> lights;
  KnownPart known{48.0F, 1.3F, 2.4F, 24.0F, 6.0F};
  static constexpr int kBlocks = 5;

  explicit Data(int width) : scene(MakeScene({}, {.noise_codes = 3.0, .light = {}})) {
    if (width > 0) scene.window.width = width;
    TakeLinearWindow(*scene.lens, scene.image.view(), scene.window, &observed);
    MarkerRaster raster;
    raster.RenderMarkerOnly(scene.marker_pattern(), scene.Guess(0.5).modules_from_undistorted,
                            observed.rays, 0.7, &map, &image, &ranges);
    for (int k = 0; k < kBlocks * kBlocks; ++k) {
      const float gain = 0.5F + 0.02F * static_cast<float>(k);
      lights.push_back({gain, 0.05F, 1.0F / (gain * 0.35F), k % 7 == 3 ? 0.0F : 0.8F});
    }
  }
};

struct Results {
  std::vector<LevelSums> levels;
  std::vector<float> weight;
  std::vector<std::int16_t> block_of;
  FitProducts products;
  std::vector<BlockMotions> blocks;
};

Results Sum(const Data& data, BlockSums sums, int tile, bool blur) {
  Results results;
  results.weight.assign(data.observed.value.size(), 0.0F);
  results.block_of.resize(data.observed.value.size());
  sums.Lay(data.scene.marker_pattern(), data.known, data.observed, data.map, data.ranges, tile,
           Data::kBlocks);
  sums.Levels(data.observed, data.image, data.lights, &results.levels);
  sums.Motions(data.observed, data.image, data.lights, blur, &results.weight, &results.products,
               &results.blocks);
  sums.WriteBlocks(data.observed, &results.block_of);
  return results;
}

class TilesOnEveryTarget : public OnEveryTarget {};

TEST_P(TilesOnEveryTarget, AddUpAsTheScalarReferenceDoes) {
  for (const int width : {0, 1, 5, 16, 19, 63}) {
    const Data data(width);
    for (const int tile : {2, 4}) {
      for (const bool blur : {false, true}) {
        const Results simd = Sum(data, BlockSums(), tile, blur);
        const Results scalar = Sum(data, BlockSums(ScalarTileKernels()), tile, blur);
        ASSERT_EQ(simd.block_of, scalar.block_of);
        for (std::size_t n = 0; n < simd.weight.size(); ++n) {
          ASSERT_NEAR(simd.weight[n], scalar.weight[n], 1e-4F * (1.0F + scalar.weight[n]));
        }
        for (std::size_t k = 0; k < simd.levels.size(); ++k) {
          const double scale = 1.0 + scalar.levels[k].w;
          EXPECT_EQ(simd.levels[k].pixels, scalar.levels[k].pixels);
          EXPECT_NEAR(simd.levels[k].w, scalar.levels[k].w, 1e-5 * scale);
          EXPECT_NEAR(simd.levels[k].wpi, scalar.levels[k].wpi, 1e-5 * scale);
          EXPECT_NEAR(simd.levels[k].wii, scalar.levels[k].wii, 1e-5 * scale);
          EXPECT_NEAR(simd.levels[k].rpp, scalar.levels[k].rpp, 1e-5 * scale);
          EXPECT_NEAR(simd.levels[k].rpi, scalar.levels[k].rpi, 1e-5 * scale);
          EXPECT_NEAR(simd.blocks[k].rr, scalar.blocks[k].rr, 1e-5 * scale);
          for (int a = 0; a < kFitParameters; ++a) {
            // Derivatives per half edge are tens of times those per pixel.
            EXPECT_NEAR(simd.blocks[k].j[a], scalar.blocks[k].j[a], 1e-3 * scale);
            EXPECT_NEAR(simd.blocks[k].pj[a], scalar.blocks[k].pj[a], 1e-3 * scale);
          }
        }
        double trace = 0.0;
        for (int a = 0, at = 0; a < kFitParameters; at += ++a + 1) trace += scalar.products.jj[at];
        for (int k = 0; k < kFitProducts; ++k) {
          EXPECT_NEAR(simd.products.jj[k], scalar.products.jj[k], 1e-5 * trace) << k;
        }
        for (int a = 0; a < kFitParameters; ++a) {
          EXPECT_NEAR(simd.products.jr[a], scalar.products.jr[a],
                      1e-4 * (1.0 + std::sqrt(trace) * 10.0))
              << a;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, TilesOnEveryTarget,
                         testing::ValuesIn(hwy::SupportedAndGeneratedTargets()));

TEST(BlockSums, AreThoseOfThePixelsOneByOne) {
  const Data data(0);
  const Results results = Sum(data, BlockSums(), 4, true);
  const int width = data.scene.window.width, height = data.scene.window.height;
  constexpr int kN = kFitParameters;
  std::array<double, kN * kN> jj{};
  std::array<double, kN> jr{};
  double pixels = 0.0, weight = 0.0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t n = static_cast<std::size_t>(y) * width + x;
      if (results.block_of[n] < 0) continue;
      ++pixels;
      const BlockLight& light = data.lights[results.block_of[n]];
      const double r = data.observed.value[n] - light.offset - light.gain * data.image.white[n];
      const double z = r * light.inverse;
      const double w =
          data.observed.inverse_variance[n] * light.robust_weight / ((1.0 + z * z) * (1.0 + z * z));
      weight += w;
      EXPECT_NEAR(results.weight[n], w, 1e-4 * (1.0 + w));
      const double half = 20.0, u = (data.map.column[n] - 24.0) / half,
                   v = (data.map.row[n] - 24.0) / half;
      const double ux = data.map.column_x[n] / half, uy = data.map.column_y[n] / half;
      const double vx = data.map.row_x[n] / half, vy = data.map.row_y[n] / half;
      const double px = data.image.white_x[n], py = data.image.white_y[n];
      const double inverse = 1.0 / (ux * vy - uy * vx);
      const double pu = (px * vy - py * vx) * inverse, pv = (py * ux - px * uy) * inverse;
      double blur = 0.0;
      if (x > 0 && y > 0 && x + 1 < width && y + 1 < height) {
        blur = 0.25 * (data.image.white_x[n + 1] - data.image.white_x[n - 1] +
                       data.image.white_y[n + width] - data.image.white_y[n - width]);
      }
      const double along = pu * u + pv * v;
      const std::array<double, kN> j{-pu,     -pu * u,   -pu * v,   -pv, -pv * u,
                                     -pv * v, along * u, along * v, blur};
      for (int a = 0; a < kN; ++a) {
        jr[a] += light.gain * w * r * j[a];
        for (int b = 0; b < kN; ++b) jj[a * kN + b] += light.gain * light.gain * w * j[a] * j[b];
      }
    }
  }
  double sum_pixels = 0.0, sum_weight = 0.0;
  for (const LevelSums& level : results.levels) sum_pixels += level.pixels;
  for (const BlockMotions& block : results.blocks) sum_weight += block.w;
  EXPECT_EQ(sum_pixels, pixels);
  EXPECT_NEAR(sum_weight, weight, 1e-4 * weight);
  // Tiles of 4 pixels assume one position on the marker. The tolerance is 3 % of the root of the
  // diagonal's product.
  for (int a = 0, at = 0; a < kN; ++a) {
    for (int b = 0; b <= a; ++b, ++at) {
      const double scale = std::sqrt(jj[a * kN + a] * jj[b * kN + b]);
      EXPECT_NEAR(results.products.jj[at], jj[a * kN + b], 0.03 * scale) << a << ", " << b;
    }
    EXPECT_NEAR(results.products.jr[a], jr[a], 0.02 * std::sqrt(jj[a * kN + a] * weight)) << a;
  }
}

}  // namespace
}  // namespace pleinair::tracker
