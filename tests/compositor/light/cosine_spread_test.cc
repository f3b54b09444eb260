#include "compositor/light/cosine_spread.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

#include "base/vector.h"
#include "compositor/light/ray_scene.h"
#include "compositor/light/sampling.h"

namespace pleinair::compositor {
namespace {

TEST(CosineSpread, HasTheDirectionsOfHammersleysSetEachOnce) {
  const TangentFrame frame(Normalized({0.3, -0.5, 0.8}));
  for (const std::uint32_t count : {1U, 7U, 32U, 256U}) {
    for (const std::uint32_t seed : {0U, 17U}) {
      const CosineSpread spread(count);
      ASSERT_EQ(spread.count(), count);
      std::set<std::uint32_t> rays;
      for (std::uint32_t place = 0; place < count; ++place) {
        const std::uint32_t ray = spread.RayAt(place);
        rays.insert(ray);
        const Vec3 expected = CosineDirection(frame, ShiftedHammersley(ray, count, seed));
        const Vec3 direction = spread.Direction(frame, place, CosineSpread::ShiftOf(seed));
        EXPECT_LT(Norm(direction - expected), 1e-7);
      }
      EXPECT_EQ(rays.size(), count);
      EXPECT_EQ(*rays.rbegin(), count - 1);
    }
  }
}

TEST(CosineSpread, HasNeighboursInAPacket) {
  const TangentFrame frame({0.0, 0.0, 1.0});
  const CosineSpread spread(256);
  double within = 0.0, apart = 0.0;
  for (std::uint32_t place = 1; place < spread.count(); ++place) {
    const auto direction = [&](std::uint32_t at) { return spread.Direction(frame, at, {}); };
    if (place % RayPacket::kSize != 0) within += Norm(direction(place) - direction(place - 1));
    apart += Norm(direction(place) - direction(place * 89 % spread.count()));
  }
  EXPECT_LT(within / (256 - 32), 0.3 * apart / 255);
}

}  // namespace
}  // namespace pleinair::compositor
