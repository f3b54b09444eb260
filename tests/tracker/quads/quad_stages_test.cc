// Tests each stage of the quad detector against a plain implementation.

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "tests/tracker/surf/on_every_target.h"
#include "tracker/quads/dark_components.h"
#include "tracker/quads/dark_mask.h"
#include "tracker/quads/quad_box.h"

namespace pleinair::tracker {
namespace {

/// Noise whose amplitude varies over the image, so that some neighbourhoods have contrast.
GreyImage UnevenNoise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  GreyImage image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int range = 1 + (x / 16 * 37 + y / 16 * 11) % 250;
      image(x, y) = static_cast<std::uint8_t>((x + 2 * y) % 6 + random() % range);
    }
  }
  return image;
}

class DarkMaskVectors : public OnEveryTarget {};

TEST_P(DarkMaskVectors, GiveWhatTheScalarReferenceGives) {
  for (const int width : {4, 15, 16, 31, 60, 64, 66, 127, 128, 200, 321}) {
    for (const DarkContrast contrast :
         {DarkContrast{64, 1, 5}, DarkContrast{64, 2, 4}, DarkContrast{30, 1, 2}}) {
      const GreyImage image = UnevenNoise(width, 37, width);
      DarkMaskBuffers buffers, scalar_buffers;
      BitMask mask, scalar_mask;
      ComputeDarkMask(image.view(), contrast, SimdDarkMaskKernels(), &buffers, &mask);
      ComputeDarkMask(image.view(), contrast, ScalarDarkMaskKernels(), &scalar_buffers,
                      &scalar_mask);
      EXPECT_EQ(mask.words, scalar_mask.words) << width;
      Image<std::uint8_t> half, scalar_half;
      HalveImage(image.view(), SimdDarkMaskKernels(), &half);
      HalveImage(image.view(), ScalarDarkMaskKernels(), &scalar_half);
      ASSERT_EQ(half.size(), scalar_half.size());
      EXPECT_TRUE(std::equal(half.data(), half.data() + half.size(), scalar_half.data())) << width;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(All, DarkMaskVectors,
                         testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return hwy::TargetName(target.param); });

TEST(DarkMask, ThresholdsHalfWayBetweenTheExtremesOfNineTiles) {
  // A step from 20 to 200 with one column of 111 between; the midpoint is 110.
  GreyImage image(32, 12);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 32; ++x) image(x, y) = x < 16 ? 20 : x == 16 ? 111 : 200;
  }
  DarkMaskBuffers buffers;
  BitMask mask;
  ComputeDarkMask(image.view(), {64, 2, 4}, ScalarDarkMaskKernels(), &buffers, &mask);
  for (int x = 0; x < 32; ++x) {
    // Tiles left of 12 have no bright neighbour and therefore no contrast.
    EXPECT_EQ(mask(x, 5), x >= 12 && x < 16) << x;
  }
  for (int y = 0; y < 12; ++y) image(16, y) = 109;
  ComputeDarkMask(image.view(), {64, 2, 4}, ScalarDarkMaskKernels(), &buffers, &mask);
  EXPECT_TRUE(mask(16, 5));
  // A quarter of the range is 65.
  for (const int value : {64, 66}) {
    for (int y = 0; y < 12; ++y) image(16, y) = static_cast<std::uint8_t>(value);
    ComputeDarkMask(image.view(), {64, 2, 2}, ScalarDarkMaskKernels(), &buffers, &mask);
    EXPECT_EQ(mask(16, 5), value == 64);
  }
}

TEST(DarkMask, HasNoSpeckleWhereThereIsOnlyNoise) {
  std::mt19937 random(5);
  for (const double sigma : {2.0, 8.0, 16.0}) {
    std::normal_distribution<double> noise(150.0, sigma);
    GreyImage image(320, 240);
    for (std::size_t i = 0; i < image.size(); ++i) {
      image.data()[i] = static_cast<std::uint8_t>(std::clamp(noise(random), 0.0, 255.0));
    }
    DarkMaskBuffers buffers;
    BitMask mask;
    ComputeDarkMask(image.view(), {150, 2, 4}, SimdDarkMaskKernels(), &buffers, &mask);
    DarkComponents components;
    components.Find(mask);
    EXPECT_LT(components.runs().size(), 1000U)
        << sigma;  // Of some 40,000 without a least contrast.
  }
}

/// Flood fill: extent and area of each component, in the order of first pixels.
std::vector<std::vector<int>> Filled(const BitMask& mask) {
  std::vector<std::uint8_t> observed(static_cast<std::size_t>(mask.width) * mask.height);
  std::vector<std::vector<int>> found;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      if (!mask(x, y) || observed[y * mask.width + x] != 0) continue;
      std::vector<int> component{x, x, y, y, 0};
      std::vector<std::pair<int, int>> open{{x, y}};
      observed[y * mask.width + x] = 1;
      while (!open.empty()) {
        const auto [i, j] = open.back();
        open.pop_back();
        component = {std::min(component[0], i), std::max(component[1], i),
                     std::min(component[2], j), std::max(component[3], j), component[4] + 1};
        for (int v = std::max(j - 1, 0); v <= std::min(j + 1, mask.height - 1); ++v) {
          for (int u = std::max(i - 1, 0); u <= std::min(i + 1, mask.width - 1); ++u) {
            if (!mask(u, v) || observed[v * mask.width + u] != 0) continue;
            observed[v * mask.width + u] = 1;
            open.emplace_back(u, v);
          }
        }
      }
      found.push_back(component);
    }
  }
  return found;
}

TEST(DarkComponents, AreThoseOfAFloodFill) {
  std::mt19937 random(9);
  DarkComponents components;
  for (const int width : {1, 63, 64, 65, 130}) {
    for (const unsigned dark_of_ten : {2U, 4U, 5U, 8U, 10U}) {
      BitMask mask{width, 40, (width + 63) / 64, {}};
      mask.words.assign(static_cast<std::size_t>(mask.words_per_row) * mask.height, 0);
      for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < width; ++x) {
          if (random() % 10 >= dark_of_ten) continue;
          mask.words[y * mask.words_per_row + x / 64] |= std::uint64_t{1} << (x % 64);
        }
      }
      components.Find(mask);
      std::vector<std::vector<int>> found;
      for (std::size_t i = 0; i < components.components().size(); ++i) {
        const DarkComponent& c = components.components()[i];
        if (c.parent != static_cast<int>(i)) continue;
        found.push_back({c.min_x, c.max_x, c.min_y, c.max_y, c.area});
        int in_runs = 0;
        for (int run = c.first_run; run >= 0; run = components.runs()[run].next) {
          in_runs += components.runs()[run].end - components.runs()[run].begin;
        }
        EXPECT_EQ(in_runs, c.area);
      }
      EXPECT_EQ(found, Filled(mask)) << width << " wide, " << dark_of_ten << " of ten dark";
    }
  }
}

/// A square of `side_px` rotated about the image centre.
Quad TurnedSquare(double side_px, double turn_deg, double middle_px) {
  Quad quad{};
  for (int i = 0; i < 4; ++i) {
    const double angle = (turn_deg + 45.0 + 90.0 * i) * std::numbers::pi / 180.0;
    quad.corners_px[i] = Vec2{middle_px, middle_px} +
                         Vec2{std::cos(angle), std::sin(angle)} * (side_px * std::sqrt(0.5));
  }
  return quad;
}

/// The dark component of such a square at half size, black on white, with an edge blurred over 3
/// px.
DarkComponent SeenAtHalfSize(const Quad& square, double side_px) {
  const Vec2 middle = (square.corners_px[0] + square.corners_px[2]) * 0.5;
  const Vec2 along = (square.corners_px[1] - square.corners_px[0]) * (1.0 / side_px);
  const int size = static_cast<int>(2.0 * middle.x);
  GreyImage image(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec2 at{x - middle.x, y - middle.y};
      // The product of both axes' coverages.
      const auto dark = [&](double from_middle) {
        return std::clamp(0.5 + (0.5 * side_px - std::fabs(from_middle)) / 3.0, 0.0, 1.0);
      };
      const double share =
          dark(at.x * along.x + at.y * along.y) * dark(at.x * along.y - at.y * along.x);
      image(x, y) = static_cast<std::uint8_t>(230.0 - 200.0 * share);
    }
  }
  GreyImage half;
  HalveImage(image.view(), ScalarDarkMaskKernels(), &half);
  DarkMaskBuffers buffers;
  BitMask mask;
  ComputeDarkMask(half.view(), {150, 1, 2}, ScalarDarkMaskKernels(), &buffers, &mask);
  DarkComponents components;
  components.Find(mask);
  // Only the rim is darker than its neighbourhood; the interior is not dark.
  return *std::ranges::max_element(components.components(), {}, [](const DarkComponent& component) {
    return component.max_x - component.min_x;
  });
}

TEST(QuadBox, IsFilledByATurnedSquareSeenAgainAtHalfSize) {
  for (const double side : {60.0, 110.0, 300.0}) {
    for (const double turn : {0.0, 5.0, 17.0, 45.0, 70.0}) {
      const Quad square = TurnedSquare(side, turn, 0.75 * side + 20.0);
      EXPECT_TRUE(FillsBoxOf(square, SeenAtHalfSize(square, side), 2)) << side << " px, " << turn;
    }
  }
}

TEST(QuadBox, IsNotFilledByWhatEndsElsewhereHoweverLargeTheSquare) {
  for (const double side : {60.0, 300.0, 1000.0}) {
    const Quad square = TurnedSquare(side, 0.0, side);
    const auto fills = [&](int inset) {  // In pixels of half size, on one side only.
      const int first = static_cast<int>(std::lround(0.25 * side));
      const int last = static_cast<int>(std::lround(0.75 * side)) - 1;
      DarkComponent component{};
      component.min_x = first + inset;
      component.min_y = first;
      component.max_x = component.max_y = last;
      return FillsBoxOf(square, component, 2);
    };
    EXPECT_TRUE(fills(0)) << side;
    EXPECT_TRUE(fills(1)) << side;
    // 6 px, where another outline is possible: a marker's rim is a tenth of its edge wide.
    EXPECT_FALSE(fills(3)) << side;
    EXPECT_FALSE(fills(-3)) << side;
  }
}

}  // namespace
}  // namespace pleinair::tracker
