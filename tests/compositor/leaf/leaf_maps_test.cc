#include "compositor/leaf/leaf_maps.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace pleinair::compositor {
namespace {

TEST(LeafMaps, OrderTissuesAsThePaperDoes) {
  Image<std::uint8_t> structure(4, 1, 3);
  const std::array<std::array<std::uint8_t, 3>, 4> texels = {
      {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {0, 0, 0}}};
  for (int x = 0; x < 4; ++x) {
    for (int c = 0; c < 3; ++c) structure(x, 0, c) = texels[x][c];
  }
  const LeafMaps maps = MapsOfStructure(structure.view());
  EXPECT_EQ(maps.pigment(2, 0, 0), 255);  // Mesophyll has the stated chlorophyll
  EXPECT_EQ(maps.thickness(2, 0), 128);   // and thickness.
  for (const int mesophyll : {2, 3}) {
    EXPECT_LT(maps.pigment(0, 0, 0), maps.pigment(1, 0, 0));
    EXPECT_LT(maps.pigment(1, 0, 0), maps.pigment(mesophyll, 0, 0));
    EXPECT_GT(maps.pigment(0, 0, 1), maps.pigment(mesophyll, 0, 1));
    EXPECT_GT(maps.pigment(0, 0, 2), maps.pigment(mesophyll, 0, 2));
    EXPECT_GT(maps.gloss(0, 0), maps.gloss(1, 0));
    EXPECT_GT(maps.gloss(1, 0), maps.gloss(mesophyll, 0));
    EXPECT_GT(maps.thickness(0, 0), maps.thickness(mesophyll, 0));
  }
}

TEST(LeafMaps, MixByShares) {
  Image<std::uint8_t> structure(2, 1, 4);  // The fourth channel takes no part.
  for (const int c : {0, 2}) structure(0, 0, c) = 100;
  structure(1, 0, 0) = 255;
  structure(1, 0, 2) = 255;
  const LeafMaps maps = MapsOfStructure(structure.view());
  EXPECT_EQ(maps.pigment(0, 0, 0), maps.pigment(1, 0, 0));
  EXPECT_NEAR(maps.pigment(0, 0, 0), 255.0 * (0.30 + 1.00) / 2.0, 1.0);
}

}  // namespace
}  // namespace pleinair::compositor
