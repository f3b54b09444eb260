// The vector code of SURF, for every instruction set that this machine has, against surf_reference.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include "tests/tracker/surf/on_every_target.h"
#include "tests/tracker/surf/surf_reference.h"
#include "tests/tracker/surf/surf_test_images.h"
#include "tracker/surf/box_levels.h"
#include "tracker/surf/descriptor_matcher.h"
#include "tracker/surf/double_size.h"
#include "tracker/surf/fast_hessian.h"
#include "tracker/surf/hessian_row.h"
#include "tracker/surf/integral_image.h"
#include "tracker/surf/response_maxima.h"
#include "tracker/surf/surf_description.h"
#include "tracker/surf/surf_orientation.h"

namespace pleinair::tracker {
namespace {

class SurfKernels : public OnEveryTarget {};

INSTANTIATE_TEST_SUITE_P(EveryTarget, SurfKernels,
                         testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return hwy::TargetName(target.param); });

TEST_P(SurfKernels, IntegralImageSumsPixelsAboveAndLeft) {
  for (const auto& [width, height] : std::vector<std::pair<int, int>>{{1, 1}, {3, 5}, {67, 9}}) {
    const GreyImage grey = DrawNoise(width, height, 7);
    IntegralImage integral;
    integral.Compute(grey.view());
    for (int y1 = 0; y1 <= height; ++y1) {
      for (int x1 = 0; x1 <= width; ++x1) {
        std::uint32_t sum = 0;
        for (int y = 0; y < y1; ++y) {
          for (int x = 0; x < x1; ++x) sum += grey(x, y);
        }
        ASSERT_EQ(integral.row(y1)[x1], sum) << x1 << ", " << y1;
      }
    }
  }
}

TEST_P(SurfKernels, BoxSumsOutliveTheOverflowOfTheIntegral) {
  GreyImage white(4200, 4200);  // 4.5e9 in all, beyond 2^32.
  std::fill_n(white.data(), white.size(), std::uint8_t{255});
  IntegralImage integral;
  integral.Compute(white.view());
  EXPECT_EQ(integral.BoxSum(4100, 4100, 4200, 4200), 255u * 100 * 100);
  HessianScratch scratch;
  std::vector<float> responses(4200 + IntegralImage::kPadding);
  ComputeHessianRow(integral, 27, 1, 4180, {0, 4200}, &scratch, responses.data());
  EXPECT_EQ(*std::max_element(responses.begin(), responses.end()), 0.0f);
  EXPECT_EQ(*std::min_element(responses.begin(), responses.end()), 0.0f);
}

TEST_P(SurfKernels, ResponsesEqualTheReference) {
  const GreyImage grey = DrawNoise(157, 121, 3);
  IntegralImage integral;
  integral.Compute(grey.view());
  HessianScratch scratch;
  for (const int size : {9, 15, 21, 27, 39, 51, 75, 99}) {
    for (const int step : {1, 2, 4}) {
      const int samples = (grey.width() + step - 1) / step;
      std::vector<float> responses(samples + IntegralImage::kPadding, -1.0f);
      for (const int y : {0, size / 2 - 1, size / 2, 60, 120 - size / 2, 121 - size / 2, 120}) {
        // In two strips.
        ComputeHessianRow(integral, size, step, y, {0, samples / 2 + 3}, &scratch,
                          responses.data());
        ComputeHessianRow(integral, size, step, y, {samples / 2, samples}, &scratch,
                          responses.data());
        for (int i = 0; i < samples; ++i) {
          double laplacian = 0;
          const double expected = reference::Response(grey, size, i * step, y, &laplacian);
          ASSERT_NEAR(responses[i], expected, 1e-6 * std::abs(expected) + 1e-9)
              << "L " << size << " step " << step << " at " << i * step << ", " << y;
          if (expected != 0) {
            ASSERT_NEAR(LaplacianAt(integral, size, i * step, y), laplacian, 1e-6);
          }
        }
      }
    }
  }
}

TEST_P(SurfKernels, EveryMaximumOfTheReferenceIsFoundOrFarOffItsParabola) {
  const GreyImage grey = TestTexture(5, 110).Draw(201, 187, 0, 1);
  constexpr double kThreshold = 1e-5;
  IntegralImage integral;
  integral.Compute(grey.view());
  FastHessian hessian;
  std::vector<SurfKeypoint> found;
  hessian.Detect(integral, 3, 1, kThreshold, &found);
  std::vector<reference::Sample> expected;
  for (const int octave : {0, 1, 2}) {
    const auto maxima = reference::Maxima(grey, octave, 1 << octave, kThreshold);
    expected.insert(expected.end(), maxima.begin(), maxima.end());
  }
  ASSERT_GT(expected.size(), 50u);
  // Interpolation refuses a few; nothing else may be missing, nothing may be added.
  EXPECT_LE(found.size(), expected.size());
  EXPECT_GE(found.size(), expected.size() * 9 / 10);
  for (const SurfKeypoint& keypoint : found) {
    const bool known = std::any_of(expected.begin(), expected.end(), [&](const auto& sample) {
      double laplacian = 0;
      const double response =
          reference::Response(grey, sample.filter_size, sample.x, sample.y, &laplacian);
      return std::abs(response - keypoint.response) < 1e-6 * response &&
             (laplacian < 0) == keypoint.bright && std::abs(sample.x - keypoint.x) <= 4 &&
             std::abs(sample.y - keypoint.y) <= 4;
    });
    EXPECT_TRUE(known) << keypoint.x << ", " << keypoint.y << " s " << keypoint.scale;
  }
}

TEST_P(SurfKernels, MaximaAreFoundAtEveryPlaceOfTheRow) {
  constexpr int kCount = 700;
  std::mt19937 random(11);
  std::vector<std::vector<float>> rows(9, std::vector<float>(kCount + 66));
  // Few different values: ties.
  for (auto& row : rows) {
    for (float& value : row) value = static_cast<float>(random() % 40);
  }
  ResponseNeighbourhood neighbourhood;
  for (int n = 0; n < 9; ++n) neighbourhood.rows[n / 3][n % 3] = rows[n].data() + 1;
  std::vector<std::int32_t> expected;
  for (int i = 0; i < kCount; ++i) {
    const float value = rows[4][i + 1];
    bool largest = value > 30;
    for (int n = 0; n < 27; ++n) {
      const float other = rows[n / 3][i + n % 3];
      if (n < 13) largest = largest && value > other;
      if (n > 13) largest = largest && value >= other;
    }
    if (largest) expected.push_back(i);
  }
  ASSERT_GT(expected.size(), 5u);
  std::vector<std::int32_t> found(kCount + 64);
  found.resize(FindResponseMaxima(neighbourhood, 0, kCount, 30, found.data()));
  EXPECT_EQ(found, expected);
}

/// A keypoint in the middle of an image, with the box (and its step) nearest to 2 s and to s.
struct Described {
  SurfKeypoint keypoint;
  int wavelet_box, wavelet_step, sample_box, sample_step;
};
const Described kDescribed[] = {
    {{.x = 60.3f, .y = 55.8f, .scale = 1.1f, .angle_rad = 0.3f}, 2, 1, 1, 1},
    {{.x = 58.0f, .y = 57.5f, .scale = 2.0f, .angle_rad = -2.1f}, 4, 2, 2, 1},
    {{.x = 61.7f, .y = 52.2f, .scale = 3.9f, .angle_rad = 1.7f}, 8, 4, 4, 2},
    {{.x = 8.2f, .y = 110.9f, .scale = 3.0f, .angle_rad = 3.0f}, 6, 2, 3, 1}};  // At the border.

TEST_P(SurfKernels, DescriptorsEqualTheReference) {
  const GreyImage grey = TestTexture(2, 70).Draw(121, 117, 0, 1);
  IntegralImage integral;
  integral.Compute(grey.view());
  BoxLevels levels;
  levels.Reset(&integral);
  for (const Described& described : kDescribed) {
    const SurfDescriptor found = DescribeKeypoint(&levels, described.keypoint, 20);
    const SurfDescriptor expected =
        reference::Describe(grey, described.keypoint, described.sample_box, described.sample_step);
    // Box means are rounded to 1/256 grey level.
    for (int n = 0; n < 64; ++n) EXPECT_NEAR(found[n], expected[n], 1e-3) << n;
  }
}

TEST_P(SurfKernels, DirectionsEqualTheReference) {
  const GreyImage grey = TestTexture(2, 70).Draw(121, 117, 0, 1);
  IntegralImage integral;
  integral.Compute(grey.view());
  BoxLevels levels;
  levels.Reset(&integral);
  for (const Described& described : kDescribed) {
    const SurfKeypoint& keypoint = described.keypoint;
    const double found = DominantDirection(&levels, keypoint.x, keypoint.y, keypoint.scale);
    const double expected =
        reference::Direction(grey, keypoint, described.wavelet_box, described.wavelet_step);
    // The histogram's windows begin every 5 degrees, the reference's at any response.
    EXPECT_LT(std::abs(std::remainder(found - expected, 2 * std::numbers::pi)), 0.08)
        << found << " " << expected;
  }
}

TEST_P(SurfKernels, DoubleSizePutsMeansBetweenPixels) {
  const GreyImage grey = DrawNoise(75, 20, 5);
  GreyImage doubled;
  DoubleSize(grey.view(), &doubled);
  ASSERT_EQ(doubled.width(), 149);
  ASSERT_EQ(doubled.height(), 39);
  for (int y = 0; y < doubled.height(); ++y) {
    for (int x = 0; x < doubled.width(); ++x) {
      const double expected = (grey(x / 2, y / 2) + grey((x + 1) / 2, y / 2) +
                               grey(x / 2, (y + 1) / 2) + grey((x + 1) / 2, (y + 1) / 2)) /
                              4.0;
      ASSERT_NEAR(doubled(x, y), expected, 1.0) << x << ", " << y;
    }
  }
}

std::vector<QuantisedDescriptor> RandomDescriptors(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<QuantisedDescriptor> descriptors(count);
  for (QuantisedDescriptor& descriptor : descriptors) {
    // Few different values, so that distances tie.
    for (std::int8_t& value : descriptor.values) {
      value = static_cast<std::int8_t>(static_cast<int>(random() % 3) * 127 - 127);
    }
    descriptor.bright = random() % 3 == 0;
  }
  return descriptors;
}

TEST_P(SurfKernels, NearestDescriptorsEqualTheReference) {
  for (const int template_count : {0, 1, 31, 170}) {
    for (const int frame_count : {0, 1, 3, 61}) {
      const auto templates = RandomDescriptors(template_count, 1);
      auto frame = RandomDescriptors(frame_count, 2);
      if (frame_count > 2 && template_count > 2) frame[1] = templates[2];
      DescriptorMatcher matcher;
      matcher.SetTemplates(templates);
      for (const int k : {1, 2, 4, DescriptorMatcher::kMaxNeighbours}) {
        std::vector<DescriptorMatch> of_frame;
        std::vector<DescriptorMatch> of_templates;
        matcher.Match(frame, k, &of_frame, &of_templates);
        ASSERT_EQ(of_frame.size(), frame.size() * k);
        ASSERT_EQ(of_templates.size(), templates.size() * k);
        std::vector<DescriptorMatch> one_way;
        matcher.Match(frame, k, &one_way, nullptr);
        ASSERT_EQ(one_way, of_frame);
        for (int i = 0; i < frame_count; ++i) {
          const auto expected = reference::Nearest(frame[i], templates, k);
          for (int n = 0; n < k; ++n) ASSERT_EQ(of_frame[i * k + n], expected[n]) << i << " " << n;
        }
        for (int i = 0; i < template_count; ++i) {
          const auto expected = reference::Nearest(templates[i], frame, k);
          for (int n = 0; n < k; ++n) {
            ASSERT_EQ(of_templates[i * k + n], expected[n]) << i << " " << n;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace pleinair::tracker
