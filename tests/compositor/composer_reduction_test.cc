// Compares drawing with reductions to full drawing, in a real scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>

#include "tests/compositor/courtyard_frame.h"

namespace pleinair::compositor {
namespace {

int MaxDifference(const RgbImage& a, const RgbImage& b) {
  int most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, std::abs(a.data()[i] - b.data()[i]));
  }
  return most;
}

/// Number of values that differ by more than two steps of 8 bits.
std::ptrdiff_t CountNoticeable(const RgbImage& a, const RgbImage& b) {
  std::ptrdiff_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(a.data()[i] - b.data()[i]) > 2;
  return count;
}

/// With linear_shadow_ratio some of the 921,600 values may differ by up to three steps. Otherwise
/// the limit is one step.
void ExpectNear(const RgbImage& drawn, const RgbImage& in_full, bool linear_shadow_ratio) {
  EXPECT_LE(MaxDifference(drawn, in_full), linear_shadow_ratio ? 3 : 1);
  EXPECT_LE(CountNoticeable(drawn, in_full), linear_shadow_ratio ? 5 : 0);
}

TEST(ComposerReduction, ChangesNextToNothingInTheCourtyard) {
  const testing::Courtyard courtyard;
  const RgbImage picture = courtyard.Picture();
  const auto composer = courtyard.MakeComposer({});
  const auto draw = [&](const DrawReductions& reductions) {
    EXPECT_TRUE(composer->SetOptions({.reductions = reductions}));
    return composer
        ->Compose(picture.view(), courtyard.poses()[testing::Courtyard::kKeyFrame],
                  courtyard.ExposureScale())
        .value();
  };
  const RgbImage reduced = draw({});
  const RgbImage in_full = draw(DrawReductions::None());
  EXPECT_GT(MaxDifference(in_full, picture), 50) << "there are an object and its shadow";
  ExpectNear(reduced, in_full, true);
  EXPECT_GT(MaxDifference(reduced, in_full), 0) << "the option is heard";
  for (bool DrawReductions::*const reduction :
       {&DrawReductions::affected_triangles, &DrawReductions::sun_footprint,
        &DrawReductions::sun_visibility, &DrawReductions::linear_shadow_ratio,
        &DrawReductions::sun_facing_triangles}) {
    DrawReductions others;
    others.*reduction = false;
    ExpectNear(draw(others), in_full, others.linear_shadow_ratio);
  }
  EXPECT_EQ(MaxDifference(draw({}), reduced), 0) << "they can be taken up again";
}

}  // namespace
}  // namespace pleinair::compositor
