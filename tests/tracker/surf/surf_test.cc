#include "tracker/surf/surf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/tracker/surf/surf_test_images.h"
#include "tracker/surf/quantised_descriptor.h"

namespace pleinair::tracker {
namespace {

std::vector<SurfKeypoint> Detect(const GreyImage& image, const SurfOptions& options = {}) {
  Surf surf(options);
  std::vector<SurfKeypoint> keypoints;
  surf.Detect(image.view(), &keypoints);
  return keypoints;
}

/// The filter whose response to a Gaussian blob is largest, px, by integrals over the blob's
/// profile: the box filters' scale is not that of the blob (nor of the Gaussian that they stand
/// for), but proportional to it.
double BestFilterSize(double sigma) {
  const auto mass = [&](double half) { return std::erf(half / (sigma * std::sqrt(2.0))); };
  double best = 0;
  double largest = 0;
  for (double size = 4; size < 150; size += 0.01) {
    const double lobe = size / 3;
    const double second = (3 * mass(lobe / 2) - mass(size / 2)) * mass(lobe - 0.5) / (size * size);
    if (second > largest) {
      largest = second;
      best = size;
    }
  }
  return best;
}

class SurfBlobs : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Sizes, SurfBlobs, testing::Values(1.4, 1.8, 2.5, 3.2, 4.0, 5.0, 6.5, 8.0));

TEST_P(SurfBlobs, AreFoundWhereTheyAreAsLargeAsTheyAre) {
  const double sigma = GetParam();
  for (const double contrast : {80.0, -60.0}) {
    const GreyImage image = DrawBlobs(150, 140, 100, {{70.3, 64.6, sigma, contrast}});
    const auto keypoints = Detect(image, {.double_size = true});
    ASSERT_FALSE(keypoints.empty());
    const SurfKeypoint& strongest = keypoints[0];
    EXPECT_NEAR(strongest.x, 70.3, 0.2);
    EXPECT_NEAR(strongest.y, 64.6, 0.2);
    EXPECT_EQ(strongest.bright, contrast > 0);
    const double expected = 1.2 * BestFilterSize(sigma) / 9;
    EXPECT_NEAR(strongest.scale, expected, 0.1 * expected);
  }
}

TEST(Surf, FindsAMaximumBetweenTwoPixelsOnce) {
  // Equal responses on both sides, exactly.
  const GreyImage image = DrawBlobs(120, 120, 100, {{59.5, 59.5, 3, 90}});
  const auto keypoints = Detect(image);
  ASSERT_EQ(keypoints.size(), 1u);
  EXPECT_NEAR(keypoints[0].x, 59.5, 0.1);
  EXPECT_NEAR(keypoints[0].y, 59.5, 0.1);
}

TEST(Surf, OrdersKeypointsByStrength) {
  const GreyImage image = TestTexture(3, 150).Draw(300, 260, 0, 1);
  const auto keypoints = Detect(image);
  ASSERT_GT(keypoints.size(), 40u);
  EXPECT_TRUE(std::is_sorted(keypoints.begin(), keypoints.end(),
                             [](const auto& a, const auto& b) { return a.response > b.response; }));
}

TEST(Surf, ResponseGrowsWithTheSquareOfTheContrast) {
  const GreyImage faint = DrawBlobs(100, 100, 128, {{50, 50, 4, 25}});
  const GreyImage strong = DrawBlobs(100, 100, 128, {{50, 50, 4, 100}});
  const auto a = Detect(faint);
  const auto b = Detect(strong);
  ASSERT_FALSE(a.empty());
  ASSERT_FALSE(b.empty());
  EXPECT_NEAR(b[0].response / a[0].response, 16, 0.5);
}

TEST(Surf, KeepsTheStrongestWithoutBuckets) {
  const GreyImage image = TestTexture(3, 150).Draw(300, 260, 0, 1);
  const auto all = Detect(image, {.max_keypoints = 100000, .bucket_px = 0});
  const auto some = Detect(image, {.max_keypoints = 30, .bucket_px = 0});
  ASSERT_EQ(some.size(), 30u);
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i].response, all[i].response);
}

TEST(Surf, ABusyCornerDoesNotUseUpTheKeypoints) {
  // Strong blobs on the left half, a single faint one on the right.
  std::vector<TestBlob> blobs = {{270, 100, 3, 30}};
  for (int y = 20; y < 190; y += 20) {
    for (int x = 20; x < 190; x += 20) blobs.push_back({x + 0.3, y + 0.6, 3, 100});
  }
  const GreyImage image = DrawBlobs(320, 200, 80, blobs);
  const auto is_the_faint_one = [](const SurfKeypoint& k) { return std::abs(k.x - 270) < 1; };
  const auto strongest = Detect(image, {.max_keypoints = 40, .bucket_px = 0});
  ASSERT_EQ(strongest.size(), 40u);
  EXPECT_TRUE(std::none_of(strongest.begin(), strongest.end(), is_the_faint_one));
  const auto fair = Detect(image, {.max_keypoints = 40, .bucket_px = 80});
  ASSERT_EQ(fair.size(), 40u);
  EXPECT_TRUE(std::any_of(fair.begin(), fair.end(), is_the_faint_one));
}

TEST(Surf, SamplesAsCoarseAsAskedForFindTheSameLargeBlob) {
  const GreyImage image = DrawBlobs(200, 200, 90, {{101.2, 98.7, 4.5, 90}});
  for (const int first_step : {1, 2, 4}) {
    const auto keypoints = Detect(image, {.first_step = first_step});
    ASSERT_FALSE(keypoints.empty()) << first_step;
    EXPECT_NEAR(keypoints[0].x, 101.2, 0.3);
    EXPECT_NEAR(keypoints[0].y, 98.7, 0.3);
  }
}

struct Features {
  std::vector<SurfKeypoint> keypoints;
  std::vector<SurfDescriptor> descriptors;
};

Features DetectAndDescribe(const GreyImage& image, const SurfOptions& options = {}) {
  Surf surf(options);
  Features features;
  surf.Detect(image.view(), &features.keypoints);
  surf.Describe(&features.keypoints, &features.descriptors);
  return features;
}

float SquaredDistance(const SurfDescriptor& a, const SurfDescriptor& b) {
  float sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += (a[n] - b[n]) * (a[n] - b[n]);
  return sum;
}

/// How well the features of an image are found again in a turned and zoomed one.
struct Repeat {
  double repeated;  ///< Share found again within 1.5 px and 25 % of scale.
  double matched;   ///< Of these, share that is also the nearest descriptor.
  double turned;    ///< Of these, share whose angle turned along, within 10 degrees.
};

Repeat FindAgain(const TestTexture& texture, double angle, double zoom,
                 const SurfOptions& options = {}) {
  constexpr int kSize = 300;
  const double kMiddle = (kSize - 1) / 2.0;
  const Features before = DetectAndDescribe(texture.Draw(kSize, kSize, 0, 1), options);
  const Features after = DetectAndDescribe(texture.Draw(kSize, kSize, angle, zoom), options);
  int visible = 0;
  int repeated = 0;
  int matched = 0;
  int turned = 0;
  for (std::size_t i = 0; i < before.keypoints.size(); ++i) {
    const SurfKeypoint& k = before.keypoints[i];
    const double c = zoom * std::cos(angle);
    const double s = zoom * std::sin(angle);
    const double x = c * (k.x - kMiddle) - s * (k.y - kMiddle) + kMiddle;
    const double y = s * (k.x - kMiddle) + c * (k.y - kMiddle) + kMiddle;
    const double scale = zoom * k.scale;
    const double border = 12 * std::max(scale, static_cast<double>(k.scale));
    if (x < border || y < border || x > kSize - border || y > kSize - border) continue;
    if (k.x < border || k.y < border || k.x > kSize - border || k.y > kSize - border) continue;
    if (scale < 1.8 || scale > 8) continue;  // What both images can show.
    ++visible;
    const auto is_repeat = [&](const SurfKeypoint& other) {
      return std::hypot(other.x - x, other.y - y) < 1.5 &&
             std::abs(std::log(other.scale / scale)) < 0.25 && other.bright == k.bright;
    };
    if (std::none_of(after.keypoints.begin(), after.keypoints.end(), is_repeat)) continue;
    ++repeated;
    std::size_t nearest = 0;
    for (std::size_t j = 1; j < after.keypoints.size(); ++j) {
      if (SquaredDistance(before.descriptors[i], after.descriptors[j]) <
          SquaredDistance(before.descriptors[i], after.descriptors[nearest])) {
        nearest = j;
      }
    }
    if (!is_repeat(after.keypoints[nearest])) continue;
    ++matched;
    const double turn = after.keypoints[nearest].angle_rad - k.angle_rad - angle;
    if (std::abs(std::remainder(turn, 2 * std::numbers::pi)) < std::numbers::pi / 18) ++turned;
  }
  EXPECT_GT(visible, 25);
  return {static_cast<double>(repeated) / visible, static_cast<double>(matched) / repeated,
          static_cast<double>(turned) / matched};
}

TEST(Surf, FindsAndMatchesKeypointsOfATurnedPicture) {
  const TestTexture texture(1, 220);
  for (const double degrees : {15.0, 45.0, 137.0, 250.0}) {
    const Repeat repeat = FindAgain(texture, degrees * std::numbers::pi / 180, 1);
    EXPECT_GT(repeat.repeated, 0.80) << degrees;
    EXPECT_GT(repeat.matched, 0.90) << degrees;
    EXPECT_GT(repeat.turned, 0.80) << degrees;
  }
  // Pixels fall on pixels.
  const Repeat quarter = FindAgain(texture, std::numbers::pi / 2, 1);
  EXPECT_GT(quarter.repeated, 0.95);
  EXPECT_GT(quarter.matched, 0.98);
  EXPECT_GT(quarter.turned, 0.98);
}

TEST(Surf, FindsAndMatchesKeypointsOfAZoomedPicture) {
  const TestTexture texture(1, 220);
  for (const double zoom : {0.7, 0.85, 1.2, 1.5, 2.0}) {
    const Repeat repeat = FindAgain(texture, 0.5, zoom);
    EXPECT_GT(repeat.repeated, 0.70) << zoom;
    EXPECT_GT(repeat.matched, 0.90) << zoom;
  }
}

TEST(Surf, DescriptorsDoNotDependOnContrastAndBrightness) {
  const GreyImage image = TestTexture(4, 150).Draw(200, 200, 0, 1);
  GreyImage changed = image;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    changed.data()[i] = static_cast<std::uint8_t>(std::lround(0.5 * changed.data()[i] + 70));
  }
  // Upright, since a direction may jump where two are equally good.
  const SurfOptions options = {.upright = true};
  const Features before = DetectAndDescribe(image, options);
  Surf surf(options);
  std::vector<SurfKeypoint> unused;
  surf.Detect(changed.view(), &unused);
  std::vector<SurfKeypoint> keypoints = before.keypoints;
  std::vector<SurfDescriptor> descriptors;
  surf.Describe(&keypoints, &descriptors);
  ASSERT_GT(keypoints.size(), 20u);
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    EXPECT_LT(SquaredDistance(descriptors[i], before.descriptors[i]), 0.01f * 0.01f * 64) << i;
  }
}

TEST(Surf, DescriptorsHaveUnitLength) {
  const Features features = DetectAndDescribe(TestTexture(4, 150).Draw(200, 200, 0, 1));
  ASSERT_FALSE(features.descriptors.empty());
  for (const SurfDescriptor& descriptor : features.descriptors) {
    EXPECT_NEAR(SquaredDistance(descriptor, SurfDescriptor{}), 1, 1e-5);
  }
}

TEST(Surf, SurvivesNoise) {
  const TestTexture texture(6, 220);
  const GreyImage clean = texture.Draw(300, 300, 0, 1);
  GreyImage noisy = clean;
  const GreyImage noise = DrawNoise(300, 300, 1);
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    // Uniform within +-12 grey levels: a standard deviation of 7.
    noisy.data()[i] = static_cast<std::uint8_t>(
        std::clamp(noisy.data()[i] + noise.data()[i] * 25 / 256 - 12, 0, 255));
  }
  const Features a = DetectAndDescribe(clean);
  const Features b = DetectAndDescribe(noisy);
  int matched = 0;
  for (std::size_t i = 0; i < a.keypoints.size(); ++i) {
    std::size_t nearest = 0;
    for (std::size_t j = 1; j < b.keypoints.size(); ++j) {
      if (SquaredDistance(a.descriptors[i], b.descriptors[j]) <
          SquaredDistance(a.descriptors[i], b.descriptors[nearest])) {
        nearest = j;
      }
    }
    matched += std::hypot(a.keypoints[i].x - b.keypoints[nearest].x,
                          a.keypoints[i].y - b.keypoints[nearest].y) < 2;
  }
  EXPECT_GT(matched, 0.8 * static_cast<double>(a.keypoints.size()));
}

TEST(Surf, UprightKeypointsHaveNoAngle) {
  const Features features =
      DetectAndDescribe(TestTexture(4, 150).Draw(200, 200, 0.4, 1), {.upright = true});
  ASSERT_FALSE(features.keypoints.empty());
  for (const SurfKeypoint& keypoint : features.keypoints) EXPECT_EQ(keypoint.angle_rad, 0.0f);
}

TEST(Surf, GivesTheSameTwice) {
  const GreyImage image = TestTexture(8, 150).Draw(250, 210, 0, 1);
  Surf surf({.double_size = true});
  std::vector<SurfKeypoint> first;
  std::vector<SurfDescriptor> first_descriptors;
  surf.Detect(image.view(), &first);
  surf.Describe(&first, &first_descriptors);
  // Another size in between must leave nothing behind.
  std::vector<SurfKeypoint> second;
  std::vector<SurfDescriptor> second_descriptors;
  surf.Detect(DrawNoise(333, 77, 1).view(), &second);
  surf.Detect(image.view(), &second);
  surf.Describe(&second, &second_descriptors);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].x, second[i].x);
    EXPECT_EQ(first[i].angle_rad, second[i].angle_rad);
  }
  EXPECT_EQ(first_descriptors, second_descriptors);
}

TEST(Surf, ReadsRowsWithAStride) {
  const GreyImage image = TestTexture(8, 150).Draw(250, 210, 0, 1);
  GreyImage wide = DrawNoise(300, 230, 5);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) wide(x + 10, y + 5) = image(x, y);
  }
  const ImageView<const std::uint8_t> inner(&wide(10, 5), 250, 210, 1, 300);
  Surf surf({});
  std::vector<SurfKeypoint> keypoints;
  surf.Detect(inner, &keypoints);
  const auto expected = Detect(image);
  ASSERT_EQ(keypoints.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(keypoints[i].x, expected[i].x);
}

TEST(Surf, PicturesOfAnySizeAreSafe) {
  const std::vector<std::array<int, 2>> sizes = {{0, 0},   {0, 5},    {5, 0},  {1, 1},   {1, 300},
                                                 {300, 1}, {2, 2},    {8, 8},  {15, 15}, {23, 23},
                                                 {24, 25}, {31, 200}, {64, 64}};
  for (const bool double_size : {false, true}) {
    Surf surf({.threshold = 0, .double_size = double_size});
    for (const auto& [width, height] : sizes) {
      const GreyImage noise = DrawNoise(width, height, 1);
      std::vector<SurfKeypoint> keypoints;
      std::vector<SurfDescriptor> descriptors;
      surf.Detect(noise.view(), &keypoints);
      // Also keypoints that are not there.
      keypoints.push_back({.x = -500, .y = 1e6f, .scale = 3});
      keypoints.push_back({.x = 0, .y = 0, .scale = 1000});
      surf.Describe(&keypoints, &descriptors);
      EXPECT_EQ(descriptors.size(), keypoints.size());
    }
  }
}

TEST(Surf, APictureOf8KIsSafe) {
  GreyImage white(7680, 4320);
  std::fill_n(white.data(), white.size(), std::uint8_t{255});
  // A blob where the integral image has long overflowed.
  const GreyImage blob = DrawBlobs(61, 61, 255, {{30, 30, 4, -200}});
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 61; ++x) white(7570 + x, 4220 + y) = blob(x, y);
  }
  const auto keypoints = Detect(white);
  ASSERT_FALSE(keypoints.empty());
  EXPECT_NEAR(keypoints[0].x, 7600, 0.2);
  EXPECT_NEAR(keypoints[0].y, 4250, 0.2);
  EXPECT_FALSE(keypoints[0].bright);
}

TEST(Surf, FlatPicturesHaveNoKeypoints) {
  for (const int grey : {0, 128, 255}) {
    GreyImage flat(320, 240);
    std::fill_n(flat.data(), flat.size(), static_cast<std::uint8_t>(grey));
    EXPECT_TRUE(Detect(flat, {.threshold = 0, .double_size = true}).empty());
  }
}

TEST(Surf, FlatSurroundingsDescribeAsZeros) {
  GreyImage flat(100, 100);
  Surf surf({});
  std::vector<SurfKeypoint> keypoints;
  surf.Detect(flat.view(), &keypoints);
  keypoints = {{.x = 50, .y = 50, .scale = 2}};
  std::vector<SurfDescriptor> descriptors;
  surf.Describe(&keypoints, &descriptors);
  EXPECT_EQ(keypoints[0].angle_rad, 0.0f);
  EXPECT_EQ(descriptors[0], SurfDescriptor{});
  EXPECT_EQ(Quantise(descriptors[0], false).values, QuantisedDescriptor{}.values);
}

TEST(Surf, NoiseGivesNoMoreThanAskedFor) {
  EXPECT_EQ(Detect(DrawNoise(640, 480, 9), {.threshold = 0, .max_keypoints = 321}).size(), 321u);
  EXPECT_TRUE(Detect(DrawNoise(640, 480, 9), {.threshold = 0, .max_keypoints = 0}).empty());
}

TEST(QuantisedDescriptor, KeepsDirectionAndSaturates) {
  SurfDescriptor descriptor = {};
  descriptor[3] = 3;
  descriptor[7] = -0.4f;
  descriptor[9] = 0.004f;
  const QuantisedDescriptor quantised = Quantise(descriptor, true);
  EXPECT_TRUE(quantised.bright);
  EXPECT_EQ(quantised.values[3], 127);
  EXPECT_EQ(quantised.values[7], -34);  // -0.4 / 3.0265 * 256 = -33.8
  EXPECT_EQ(quantised.values[9], 0);    // 0.3
}

}  // namespace
}  // namespace pleinair::tracker
