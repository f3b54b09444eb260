// Tests every published formula against published values.
#include "accuracy/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "accuracy/distributions.h"
#include "accuracy/normal_quantile.h"
#include "accuracy/random.h"

namespace pleinair::accuracy {
namespace {

// Known answers of the Random123 library 1.0 (kat_vectors, philox 4x32 10).
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(Philox({0, 0, 0, 0}, {0, 0}),
            (std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  constexpr std::uint32_t kOnes = 0xffffffff;
  EXPECT_EQ(Philox({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(Philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (std::array<std::uint32_t, 4>{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, HasMeanAndVarianceOfItsDistributions) {
  RandomStream random(1, "test");
  double sum = 0.0, sum2 = 0.0, uniform = 0.0;
  constexpr int kDraws = 200000;
  for (int i = 0; i < kDraws; ++i) {
    const double normal = random.Normal();
    sum += normal;
    sum2 += normal * normal;
    uniform += random.Uniform();
  }
  // Tolerance: five standard errors.
  EXPECT_NEAR(sum / kDraws, 0.0, 5.0 / std::sqrt(kDraws));
  EXPECT_NEAR(sum2 / kDraws, 1.0, 5.0 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(uniform / kDraws, 0.5, 5.0 * std::sqrt(1.0 / 12 / kDraws));
  EXPECT_NE(RandomStream(1, "a").Word(), RandomStream(1, "b").Word());
  EXPECT_NE(RandomStream(1, "a").Word(), RandomStream(2, "a").Word());
}

// Wichura 1988, section "Test": PPND16 at 0.25, 0.001 and 1e-20.
TEST(NormalQuantile, GivesThePublishedValues) {
  EXPECT_NEAR(NormalQuantile(0.25), -0.6744897501960817, 1e-15);
  EXPECT_NEAR(NormalQuantile(0.001), -3.090232306167814, 1e-14);
  EXPECT_NEAR(NormalQuantile(1e-20), -9.262340089798408, 1e-13);
  EXPECT_NEAR(NormalCdf(NormalQuantile(0.975)), 0.975, 1e-15);
}

// Abramowitz & Stegun 1964, table 26.8.
TEST(ChiSquare, GivesThePublishedQuantiles) {
  EXPECT_NEAR(ChiSquareQuantile(0.95, 1), 3.84146, 5e-6);
  EXPECT_NEAR(ChiSquareQuantile(0.95, 10), 18.3070, 5e-5);
  EXPECT_NEAR(ChiSquareQuantile(0.025, 100), 74.2219, 5e-5);
  EXPECT_NEAR(ChiSquareQuantile(0.975, 100), 129.561, 5e-4);
  for (const double degrees : {1.0, 6.0, 1200.0, 60000.0}) {
    EXPECT_NEAR(ChiSquareCdf(ChiSquareQuantile(0.3, degrees), degrees), 0.3, 1e-9) << degrees;
  }
}

// Newcombe 1998, "Two-sided confidence intervals for the single proportion", table I, method 3.
TEST(WilsonInterval, GivesThePublishedIntervals) {
  const auto expect = [](std::int64_t hits, std::int64_t trials, double low, double high) {
    const Interval interval = WilsonInterval(hits, trials);
    EXPECT_NEAR(interval.low, low, 5e-5) << hits << "/" << trials;
    EXPECT_NEAR(interval.high, high, 5e-5) << hits << "/" << trials;
  };
  expect(81, 263, 0.2553, 0.3662);
  expect(15, 148, 0.0624, 0.1605);
  expect(0, 20, 0.0, 0.1611);
  expect(1, 29, 0.0061, 0.1718);
  expect(20, 20, 1 - 0.1611, 1.0);
}

// Hyndman & Fan 1996, definition 7.
TEST(Percentile, InterpolatesBetweenTheNearestRanks) {
  EXPECT_DOUBLE_EQ(Percentile({4, 1, 3, 2}, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(Percentile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(Percentile({4, 1, 3, 2}, 1.0), 4.0);
  EXPECT_TRUE(std::isnan(Percentile({}, 0.5)));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Percentile({1, kInfinity, 2}, 0.5), 2.0);
  EXPECT_EQ(Percentile({1, kInfinity, 2}, 0.75), kInfinity);
  EXPECT_EQ(Percentile({kInfinity, kInfinity}, 0.3), kInfinity);
}

// Bar-Shalom, Li & Kirubarajan 2001, section 5.4.2: 100 degrees of freedom over 50 runs of two.
TEST(MeanChiSquareBand, GivesThePublishedBand) {
  const Interval band = MeanChiSquareBand(2, 50);
  EXPECT_NEAR(band.low, 1.5, 0.05);
  EXPECT_NEAR(band.high, 2.6, 0.05);
}

TEST(McNemar, SumsTheBinomialDistribution) {
  // 2 · (C(12,0) + C(12,1) + C(12,2)) / 2¹².
  EXPECT_NEAR(McNemarExact(10, 2), 2.0 * (1 + 12 + 66) / 4096, 1e-15);
  EXPECT_EQ(McNemarExact(3, 3), 1.0);
  EXPECT_EQ(McNemarExact(0, 0), 1.0);
  EXPECT_NEAR(SignTestGreater(10, 2), (1.0 + 12 + 66) / 4096, 1e-15);
}

// Wilcoxon, Katti & Wilcox 1970, table II, 10 pairs. The smaller rank sum is at most 8 with
// probability 0.0244 and at most 10 with 0.0420.
TEST(SignedRank, GivesThePublishedProbabilities) {
  std::vector<double> differences(10);
  std::iota(differences.begin(), differences.end(), 1.0);
  differences[7] = -8;  // The sum of negative ranks becomes 8.
  EXPECT_NEAR(SignedRankGreater(differences), 0.0244, 5e-5);
  differences[1] = -2;  // The sum becomes 10.
  EXPECT_NEAR(SignedRankGreater(differences), 0.0420, 5e-5);
  EXPECT_EQ(SignedRankGreater({0.0, 0.0}), 1.0);
}

TEST(SignedRank, IsRightAboutHowOftenItIsWrong) {
  // 5 % of 2,000 samples without an effect may have p < 0.05: 100 ± 5 standard deviations.
  RandomStream random(3, "signed rank");
  int below = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> differences(40);
    for (double& difference : differences) difference = random.Normal();
    below += SignedRankGreater(differences) < 0.05;
  }
  EXPECT_NEAR(below, 100, 50);
}

// Holm 1979: 0.005, 0.01, 0.03, 0.04 at level 0.05; the third is compared with 0.05/2.
TEST(Holm, StopsAtTheFirstThatStands) {
  EXPECT_EQ(HolmRejections({0.01, 0.04, 0.03, 0.005}, 0.05),
            (std::vector<bool>{true, false, false, true}));
  EXPECT_TRUE(HolmRejections({}, 0.05).empty());
}

TEST(Bootstrap, CoversTheMeanAsOftenAsItSays) {
  RandomStream random(5, "bootstrap");
  int covered = 0;
  constexpr int kTrials = 200;
  for (int i = 0; i < kTrials; ++i) {
    std::vector<double> values(60);
    for (double& value : values) value = random.Normal() + 2.0;
    const Interval interval = BootstrapInterval(
        values.size(),
        [&](const std::vector<std::size_t>& drawn) {
          double sum = 0.0;
          for (const std::size_t index : drawn) sum += values[index];
          return sum / static_cast<double>(drawn.size());
        },
        "trial " + std::to_string(i), 400);
    covered += interval.Contains(2.0);
  }
  EXPECT_GT(covered, 0.88 * kTrials);
}

// A drawing omits a given one of ten with probability 0.9^10 = 35 %. It omits one of two given ones
// with 1 - (1 - 2 0.9^10 + 0.8^10) = 59 %.
TEST(Bootstrap, IsOpenWhereTheDataBoundNothing) {
  using Drawing = std::vector<std::size_t>;
  const auto times = [](const Drawing& drawn, std::size_t index) {
    return static_cast<double>(std::count(drawn.begin(), drawn.end(), index));
  };
  const Interval open = BootstrapInterval(
      10, [&](const Drawing& drawn) { return 10 / times(drawn, 0); }, "open");
  EXPECT_GE(open.low, 2.0);
  EXPECT_LE(open.low, 5.0);
  EXPECT_TRUE(std::isinf(open.high));
  // 0/0 is omitted,
  const Interval some = BootstrapInterval(
      10, [&](const Drawing& drawn) { return times(drawn, 0) / times(drawn, 0); }, "some");
  EXPECT_EQ(some.low, 1.0);
  EXPECT_EQ(some.high, 1.0);
  // … unless it occurs in most drawings.
  const Interval few = BootstrapInterval(
      10,
      [&](const Drawing& drawn) {
        const double both = times(drawn, 0) * times(drawn, 1);
        return both / both;
      },
      "few");
  EXPECT_TRUE(std::isnan(few.low) && std::isnan(few.high));
}

// Fisher & Yates 1938, "Statistical Tables", table III: two-sided 5 % and 0.1 % points.
TEST(Student, GivesThePublishedQuantiles) {
  EXPECT_NEAR(StudentQuantile(0.975, 1), 12.706, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.975, 2), 4.303, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.975, 5), 2.571, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.9995, 10), 4.587, 5e-4);
  EXPECT_NEAR(StudentQuantile(0.025, 60), -2.000, 5e-4);
  for (const double degrees : {1.0, 4.0, 300.0}) {
    EXPECT_NEAR(StudentCdf(StudentQuantile(0.7, degrees), degrees), 0.7, 1e-12) << degrees;
  }
}

// Student 1908, "The probable error of a mean": additional hours of sleep of ten patients under two
// drugs. Expected values from R's t.test of these data (`sleep`), t = 4.0621.
TEST(MeanInterval, IsThatOfStudentsOwnExample) {
  const std::vector<double> hours{1.2, 2.4, 1.3, 1.3, 0.0, 1.0, 1.8, 0.8, 4.6, 1.4};
  const auto interval = MeanInterval(hours);
  ASSERT_TRUE(interval.has_value());
  EXPECT_NEAR(interval->low, 0.7001142, 1e-6);
  EXPECT_NEAR(interval->high, 2.4598858, 1e-6);
  EXPECT_NEAR(MeanGreater(hours, 0.0), 0.002833 / 2, 1e-6);
  EXPECT_GT(MeanGreater(hours, 1.58), 0.499);
  EXPECT_FALSE(MeanInterval({1.0}).has_value());
  EXPECT_EQ(MeanGreater({1.0}, 0.0), 1.0);
  EXPECT_EQ(MeanGreater({1.0, 1.0}, 0.5), 0.0);
  EXPECT_EQ(MeanGreater({1.0, 1.0}, 1.0), 1.0);
}

}  // namespace
}  // namespace pleinair::accuracy
