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

const testing::Courtyard& TheCourtyard() {
  static const testing::Courtyard courtyard;
  return courtyard;
}

TEST(ComposerReduction, ChangesNextToNothingInTheCourtyard) {
  const testing::Courtyard& courtyard = TheCourtyard();
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
        &DrawReductions::sun_facing_triangles, &DrawReductions::affected_tiles}) {
    DrawReductions others;
    others.*reduction = false;
    ExpectNear(draw(others), in_full, others.linear_shadow_ratio);
  }
  EXPECT_EQ(MaxDifference(draw({}), reduced), 0) << "they can be taken up again";
}

TEST(ComposerReduction, InterpolatesTheRatioOfSkyLightWithoutNoticeableError) {
  const testing::Courtyard& courtyard = TheCourtyard();
  const RgbImage picture = courtyard.Picture();
  std::array<RgbImage, 2> composed;
  for (const bool coarse : {false, true}) {
    const auto composer = courtyard.MakeComposer({.reductions = {.coarse_sky_ratio = coarse}});
    // With a blur the coarse grid saves enough to be used for so small an image.
    ASSERT_TRUE(composer->SetCameraLook(CameraLook{.blur_px = 0.9}));
    composed[coarse ? 1 : 0] =
        composer
            ->Compose(picture.view(), courtyard.poses()[testing::Courtyard::kKeyFrame],
                      courtyard.ExposureScale())
            .value();
  }
  EXPECT_GT(MaxDifference(composed[0], composed[1]), 0) << "the option is heard";
  EXPECT_LE(MaxDifference(composed[0], composed[1]), 2);
  std::size_t different = 0;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    different += composed[0].data()[i] != composed[1].data()[i] ? 1 : 0;
  }
  EXPECT_LT(different, picture.size() / 100);
}

TEST(ComposerReduction, DrawsTheSameBytesInAffectedTilesAsInTheWholePicture) {
  const testing::Courtyard& courtyard = TheCourtyard();
  const RgbImage picture = courtyard.Picture();
  const CameraLook look{.blur_px = 0.9,
                        .noise_constant = {1e-5, 1e-5, 1e-5},
                        .noise_slope = {1e-3, 1e-3, 1e-3},
                        .neighbour_correlation = 0.2};
  for (const double k1 : {0.0, -0.2}) {
    CameraModel lens = courtyard.camera();
    lens.distortion = {k1};
    std::array<RgbImage, 2> composed;
    for (const bool tiles : {false, true}) {
      const auto composer = courtyard.MakeComposer(
          {.reductions = {.affected_tiles = tiles, .coarse_sky_ratio = false}}, lens);
      ASSERT_TRUE(composer->SetCameraLook(look));
      // Each frame finds what the one before has left in the targets.
      for (const std::size_t frame : {std::size_t{0}, std::size_t{testing::Courtyard::kKeyFrame}}) {
        composed[tiles ? 1 : 0] =
            composer->Compose(picture.view(), courtyard.poses()[frame], courtyard.ExposureScale())
                .value();
      }
    }
    EXPECT_GT(MaxDifference(composed[0], picture), 50);
    EXPECT_EQ(MaxDifference(composed[0], composed[1]), 0) << "k1 = " << k1;
  }
}

}  // namespace
}  // namespace pleinair::compositor
