#include "devices/images/resize_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

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

}  // namespace
}  // namespace pleinair::devices
