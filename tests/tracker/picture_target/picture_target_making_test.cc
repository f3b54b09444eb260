// Tests which images make targets, and their ratings.
#include "tracker/picture_target/target_making.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "base/srgb.h"
#include "tests/tracker/picture_target/picture_target_scenes.h"
#include "tracker/picture_target/target_file.h"
#include "tracker/picture_target/target_quality.h"
#include "tracker/picture_target/target_views.h"

namespace pleinair::tracker {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

GreyImage Drawn(int width, int height, const std::function<double(double, double)>& code) {
  GreyImage picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture(x, y) = static_cast<std::uint8_t>(std::clamp(code(x, y), 0.0, 255.0));
    }
  }
  return picture;
}

Result<PictureTarget> Make(const GreyImage& picture) {
  return MakePictureTarget(picture.view(), Metres(0.4), "picture");
}

TEST(TargetMaking, KeepsShapeSizeAndLight) {
  const GreyImage picture = DeadLeaves(5, 1024, 512).Codes();
  const auto target = MakePictureTarget(picture.view(), Metres(0.3), "leaves");
  ASSERT_TRUE(target.has_value()) << target.error().Message();
  EXPECT_EQ(target->name, "leaves");
  EXPECT_DOUBLE_EQ(target->width_m, 0.3);
  EXPECT_DOUBLE_EQ(target->height_m, 0.15);
  ASSERT_EQ(target->picture.width(), 512);
  ASSERT_EQ(target->picture.height(), 256);
  // Halved by means of four pixels in linear light.
  const auto& linear = LinearFromSrgb8();
  for (int y = 3; y < 256; y += 41) {
    for (int x = 5; x < 512; x += 37) {
      const double mean =
          0.25 * (linear[picture(2 * x, 2 * y)] + linear[picture(2 * x + 1, 2 * y)] +
                  linear[picture(2 * x, 2 * y + 1)] + linear[picture(2 * x + 1, 2 * y + 1)]);
      EXPECT_NEAR(target->picture(x, y), 255.0 * SrgbFromLinear(mean), 0.51);
    }
  }
  // Keypoints come from many views, and all lie on the picture.
  EXPECT_GT(target->views.size(), 40U);
  EXPECT_GT(target->keypoints.size(), 1000U);
  EXPECT_LE(target->keypoints.size(), static_cast<std::size_t>(kMaxTargetKeypoints));
  ASSERT_EQ(target->keypoints.size(), target->descriptors.size());
  for (const TargetKeypoint& keypoint : target->keypoints) {
    const Vec2 place = PlaceOnTarget(*target, keypoint);
    EXPECT_TRUE(place.x > -0.5 && place.x < kTargetSide + 0.5) << place.x;
    EXPECT_TRUE(place.y > -0.5 && place.y < kTargetSide + 0.5) << place.y;
  }
  // The frontal view has the picture's aspect ratio.
  const auto& frontal = target->views[kFrontalView].from_target;
  EXPECT_NEAR(frontal[0] / frontal[4], 2.0, 1e-9);
  EXPECT_NEAR(frontal[1], 0.0, 1e-9);
  // The same image makes the same file, and the file contains the complete target.
  const auto again = MakePictureTarget(picture.view(), Metres(0.3), "leaves");
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(SerializeTarget(*again), SerializeTarget(*target));
  const auto read = ParseTarget(SerializeTarget(*target), "leaves.target");
  ASSERT_TRUE(read.has_value()) << read.error().Message();
}

TEST(TargetMaking, SaysWhatToDoAboutPicturesWithoutFeatures) {
  const std::vector<GreyImage> pictures{
      Drawn(300, 200, [](double, double) { return 0.0; }),
      Drawn(300, 200, [](double, double) { return 255.0; }),
      Drawn(300, 200, [](double x, double) { return 0.8 * x; }),
      Drawn(300, 200,
            [](double x, double y) { return std::hypot(x - 150, y - 100) < 50 ? 240 : 30; }),
      // Detail below a camera's resolution.
      Drawn(300, 200, [](double x, double y) { return 128 + std::fmod(7 * x + 13 * y, 4); })};
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    SCOPED_TRACE(i);
    const auto target = Make(pictures[i]);
    ASSERT_FALSE(target.has_value());
    EXPECT_EQ(target.error().kind, ErrorKind::kInput);
    EXPECT_THAT(target.error().Message(), HasSubstr("too few features"));
    EXPECT_THAT(target.error().remedy, HasSubstr("more fine detail"));
  }
}

TEST(TargetMaking, WantsFeaturesInMoreThanACorner) {
  const GreyImage leaves = DeadLeaves(6, 400, 400).Codes();
  const GreyImage corner = Drawn(1500, 1500, [&](double x, double y) {
    return x < 400 && y < 400 ? leaves(static_cast<int>(x), static_cast<int>(y)) : 200.0;
  });
  const auto target = Make(corner);
  ASSERT_FALSE(target.has_value());
  EXPECT_THAT(target.error().Message(), HasSubstr("one small part"));
  EXPECT_THAT(target.error().remedy, HasSubstr("crop it to that part"));
}

TEST(TargetMaking, RefusesSizesShapesAndNamesThatAreNone) {
  const GreyImage leaves = DeadLeaves(6, 300, 200).Codes();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double width_m : {0.0, -0.1, nan, HUGE_VAL, 1e-5, 1e5}) {
    EXPECT_FALSE(MakePictureTarget(leaves.view(), Metres(width_m), "x").has_value()) << width_m;
  }
  for (const std::string& name :
       {std::string(), std::string("a\nb"), std::string(201, 'a'), std::string("\xe4"),
        std::string("a\0b", 3), std::string("\x80")}) {
    EXPECT_FALSE(MakePictureTarget(leaves.view(), Metres(0.1), name).has_value()) << name;
    EXPECT_FALSE(IsTargetName(name));
  }
  EXPECT_TRUE(IsTargetName("Žluťoučký kůň 日本 🐎"));
  for (const auto& [width, height] : {std::pair{0, 0}, {1, 1}, {31, 31}, {700, 100}, {100, 700}}) {
    EXPECT_FALSE(Make(GreyImage(width, height)).has_value()) << width << "x" << height;
  }
  EXPECT_FALSE(MakePictureTarget(RgbImage(300, 200, 3).view(), Metres(0.1), "x").has_value());
}

TEST(TargetQuality, OfAPictureFullOfDetailIsGood) {
  const auto target = Make(DeadLeaves(8, 800, 600).Codes());
  ASSERT_TRUE(target.has_value());
  const TargetQuality quality = RateTarget(*target);
  EXPECT_GE(quality.features, 100);
  EXPECT_GT(quality.coverage, 0.85);
  EXPECT_GT(quality.contrast, 0.85);
  EXPECT_LT(quality.repetition, 0.15);
  EXPECT_LT(quality.turned_likeness, 0.4);
  EXPECT_GE(quality.score, 80);
  EXPECT_THAT(quality.advice, IsEmpty());
}

TEST(TargetQuality, OfWallpaperIsPoorBecauseItRepeats) {
  const GreyImage tile = DeadLeaves(9, 80, 80).Codes();
  const auto target = Make(Drawn(640, 480, [&](double x, double y) {
    return tile(static_cast<int>(x) % 80, static_cast<int>(y) % 80);
  }));
  ASSERT_TRUE(target.has_value());
  const TargetQuality quality = RateTarget(*target);
  EXPECT_GT(quality.repetition, 0.8);
  EXPECT_LT(quality.score, 40);
  ASSERT_FALSE(quality.advice.empty());
  EXPECT_THAT(quality.advice[0], HasSubstr("repeats"));
}

TEST(TargetQuality, WarnsOfPicturesThatLookTheSameTurnedRound) {
  const GreyImage half = DeadLeaves(10, 600, 300).Codes();
  const auto target = Make(Drawn(600, 600, [&](double x, double y) {
    return y < 300 ? half(static_cast<int>(x), static_cast<int>(y))
                   : half(599 - static_cast<int>(x), 599 - static_cast<int>(y));
  }));
  ASSERT_TRUE(target.has_value());
  const TargetQuality quality = RateTarget(*target);
  EXPECT_GT(quality.turned_likeness, 0.99);
  EXPECT_LT(quality.score, 20);
  EXPECT_THAT(quality.advice, Contains(HasSubstr("turned round")));
}

TEST(TargetQuality, AsksForDetailWhereAPictureIsEven) {
  const GreyImage leaves = DeadLeaves(11, 400, 600).Codes();
  const auto target = Make(Drawn(900, 600, [&](double x, double y) {
    return x < 400 ? leaves(static_cast<int>(x), static_cast<int>(y)) : 210.0;
  }));
  ASSERT_TRUE(target.has_value());
  const TargetQuality quality = RateTarget(*target);
  EXPECT_LT(quality.coverage, 0.6);
  EXPECT_LT(quality.contrast, 0.6);
  EXPECT_LT(quality.score, 60);
  EXPECT_THAT(quality.advice, Contains(HasSubstr("even")));
}

}  // namespace
}  // namespace pleinair::tracker
