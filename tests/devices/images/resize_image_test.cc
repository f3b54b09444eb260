#include "devices/images/resize_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace pleinair::devices {
namespace {

TEST(ResizeRgb, KeepsAFlatPictureFlat) {
  RgbImage flat(64, 48, 3);
  std::fill_n(flat.data(), flat.size(), static_cast<std::uint8_t>(77));
  const RgbImage resized = ResizeRgb(flat.view(), 21, 100);
  EXPECT_EQ(resized.width(), 21);
  EXPECT_EQ(resized.height(), 100);
  EXPECT_EQ(std::count(resized.data(), resized.data() + resized.size(), 77),
            static_cast<std::ptrdiff_t>(resized.size()));
}

TEST(ResizeDeep, MakesTheSameImageAsResizeRgb) {
  RgbImage ramp(60, 40, 3);
  DeepImage deep(60, 40, 3);
  for (std::size_t i = 0; i < ramp.size(); ++i) {
    ramp.data()[i] = static_cast<std::uint8_t>(i / 37 % 251);
    deep.data()[i] = static_cast<std::uint16_t>(257 * ramp.data()[i]);
  }
  for (const auto& [width, height] : {std::pair(30, 20), std::pair(90, 70)}) {
    const RgbImage rgb = ResizeRgb(ramp.view(), width, height);
    const DeepImage resized = ResizeDeep(deep.view(), width, height);
    ASSERT_EQ(resized.size(), rgb.size());
    for (std::size_t i = 0; i < rgb.size(); ++i) {
      ASSERT_NEAR(resized.data()[i] / 257.0, rgb.data()[i], 1.0) << i;
    }
  }
}

}  // namespace
}  // namespace pleinair::devices
