#include "compositor/photometry/linear_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/camera_image.h"
#include "base/srgb.h"

namespace pleinair::compositor {
namespace {

TEST(SampleLinear, UsesTheDepthOfTheSource) {
  const CameraResponse srgb;
  // All values from 99.5 to 100.5 are 100 in 8 bits.
  for (const double code : {99.6, 100.0, 100.4}) {
    RgbImage rgb(2, 2, 3);
    DeepImage deep(2, 2, 3);
    for (std::size_t i = 0; i < rgb.size(); ++i) {
      rgb.data()[i] = 100;
      deep.data()[i] = static_cast<std::uint16_t>(std::lround(257.0 * code));
    }
    const auto light =
        SampleLinear({std::as_const(rgb).view(), std::as_const(deep).view()}, {0.3, 0.6}, srgb);
    const auto rounded = SampleLinear(rgb.view(), {0.3, 0.6}, srgb);
    ASSERT_TRUE(light && rounded);
    for (const int c : {0, 1, 2}) {
      EXPECT_NEAR((*light)[c], LinearFromSrgb(code / 255.0), 1e-5) << code;
      EXPECT_NEAR((*rounded)[c], LinearFromSrgb(100.0 / 255.0), 1e-6);
    }
  }
}

TEST(SampleLinear, OfValuesOf8BitsIsThatOf8Bits) {
  const CameraResponse srgb;
  for (int code = 0; code <= 255; ++code) {
    EXPECT_EQ(srgb.LinearOf16(static_cast<std::uint16_t>(257 * code), 0), srgb.Linear(0)[code]);
  }
}

}  // namespace
}  // namespace pleinair::compositor
