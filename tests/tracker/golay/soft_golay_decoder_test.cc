#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "tests/tracker/surf/on_every_target.h"
#include "tracker/golay/golay_scores.h"
#include "tracker/golay/soft_golay_decoder.h"

namespace pleinair::tracker {
namespace {

using ::testing::HasSubstr;

/// Cells with certain values for a number.
CellLikelihoods CleanCells(int number, float likelihood = 4.0F) {
  CellLikelihoods cells;
  for (int i = 0; i < kGolayBits; ++i) {
    cells[i] = (CodewordOfNumber(number) >> i & 1U) != 0 ? likelihood : -likelihood;
  }
  return cells;
}

CellLikelihoods Erase(CellLikelihoods cells, GolayWord erased) {
  for (int i = 0; i < kGolayBits; ++i) {
    if ((erased >> i & 1U) != 0) cells[i] = 0.0F;
  }
  return cells;
}

/// Σ ±likelihood as documented, in the order of the cells.
double Correlation(const CellLikelihoods& cells, int number) {
  double sum = 0.0;
  for (int i = 0; i < kGolayBits; ++i) {
    sum += (CodewordOfNumber(number) >> i & 1U) != 0 ? cells[i] : -cells[i];
  }
  return sum;
}

CellLikelihoods RandomCells(std::mt19937& random) {
  // A mixture of certain, doubtful and erased cells.
  std::normal_distribution<float> normal(0.0F, 3.0F);
  std::bernoulli_distribution erased(0.1);
  CellLikelihoods cells;
  for (float& cell : cells) cell = erased(random) ? 0.0F : normal(random);
  return cells;
}

GolayWord RandomPattern(std::mt19937& random, int weight) {
  std::array<int, kGolayBits> order;
  std::iota(order.begin(), order.end(), 0);
  GolayWord pattern = 0;
  for (int i = 0; i < weight; ++i) {
    std::swap(order[i], order[std::uniform_int_distribution(i, kGolayBits - 1)(random)]);
    pattern |= 1U << order[i];
  }
  return pattern;
}

class GolayScoresOnEveryTarget : public OnEveryTarget {};

TEST_P(GolayScoresOnEveryTarget, EqualTheScalarSumsOfEveryWord) {
  std::mt19937 random(2);
  std::uniform_int_distribution<std::int32_t> weight(-65'536'000, 65'536'000);
  for (int round = 0; round < 20; ++round) {
    std::array<std::int32_t, kGolayBits> weights;
    for (auto& w : weights) w = weight(random);
    GolayScores scores;
    ScoreGolayWords(weights, scores);
    GolayScores expected{};
    for (int n = 0; n < kGolayNumbers; ++n) {
      const GolayWord word = EncodeGolay(n);
      for (int i = 0; i < kGolayBits; ++i) {
        expected[n] += (word >> i & 1U) != 0 ? weights[i] : -weights[i];
      }
    }
    ASSERT_EQ(scores, expected);
    std::sort(expected.begin(), expected.end(), std::greater<>());
    EXPECT_EQ(FindTopTwo(scores).best, expected[0]);
    EXPECT_EQ(FindTopTwo(scores).second, expected[1]);
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, GolayScoresOnEveryTarget,
                         ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) {
                           return std::string(hwy::TargetName(target.param));
                         });

TEST(SoftGolayDecoder, KnowsPrintsWithoutAWrongCellAsDecodeDoes) {
  SoftGolayDecoder some;
  ASSERT_TRUE(some.SetNumbersInUse(std::vector<int>{3, 7, 4095}).has_value());
  for (int number = 0; number < kGolayNumbers; ++number) {
    const GolayWord print = CodewordOfNumber(number);
    ASSERT_EQ(SoftGolayDecoder().NumberOfCells(print), number);
    ASSERT_EQ(some.NumberOfCells(print).has_value(), number == 3 || number == 7 || number == 4095);
    ASSERT_FALSE(SoftGolayDecoder().NumberOfCells(print ^ (1U << (number % kGolayBits))));
  }
  const CellLikelihoods cells = CleanCells(7, 6.0F);
  EXPECT_EQ(SoftGolayDecoder().Decode(cells).number, 7);
  EXPECT_EQ(SoftGolayDecoder().Decode(cells).margin, 96.0F);
  EXPECT_GE(some.Decode(cells).margin, 96.0F);
}

TEST(SoftGolayDecoder, ReadsEveryCleanPrint) {
  const SoftGolayDecoder decoder;
  for (int n = 0; n < kGolayNumbers; ++n) {
    const SoftGolayDecoding decoding = decoder.Decode(CleanCells(n));
    ASSERT_EQ(decoding.number, n);
    ASSERT_FLOAT_EQ(decoding.score, 24 * 4.0F);
    // The nearest other codeword differs in eight cells.
    ASSERT_FLOAT_EQ(decoding.margin, 2 * 8 * 4.0F);
    ASSERT_EQ(std::popcount(CodewordOfNumber(n) ^ CodewordOfNumber(*decoding.second_number)), 8);
    ASSERT_FLOAT_EQ(decoding.agreement, 1.0F);
    ASSERT_EQ(decoding.disagreements, 0);
    ASSERT_EQ(decoding.erasures, 0);
  }
}

TEST(SoftGolayDecoder, EqualsBruteForceOnRandomLikelihoods) {
  std::mt19937 random(3);
  const SoftGolayDecoder decoder;
  for (int round = 0; round < 300; ++round) {
    const CellLikelihoods cells = RandomCells(random);
    std::vector<double> scores(kGolayNumbers);
    for (int n = 0; n < kGolayNumbers; ++n) scores[n] = Correlation(cells, n);
    const SoftGolayDecoding decoding = decoder.Decode(cells);
    std::vector<double> sorted = scores;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    // Rounding: 24 · 2⁻¹⁷ per score.
    EXPECT_NEAR(scores[decoding.number], sorted[0], 4e-4);
    EXPECT_NEAR(scores[*decoding.second_number], sorted[1], 4e-4);
    EXPECT_NE(decoding.number, *decoding.second_number);
    EXPECT_NEAR(decoding.score, sorted[0], 2e-4);
    EXPECT_NEAR(decoding.margin, sorted[0] - sorted[1], 4e-4);
    EXPECT_EQ(decoding.shortfall, 0.0F);
    double evidence = 0.0;
    int disagreements = 0;
    for (int i = 0; i < kGolayBits; ++i) {
      evidence += std::abs(cells[i]);
      const bool white = (CodewordOfNumber(decoding.number) >> i & 1U) != 0;
      disagreements += (white && cells[i] < 0) || (!white && cells[i] > 0) ? 1 : 0;
    }
    EXPECT_NEAR(decoding.agreement, sorted[0] / evidence, 1e-4);
    EXPECT_EQ(decoding.disagreements, disagreements);
    EXPECT_EQ(decoding.erasures, std::count(cells.begin(), cells.end(), 0.0F));
  }
}

// With four wrong cells another number is equally near: no hard decoder can correct them.
TEST(SoftGolayDecoder, CorrectsFourDoubtfulCells) {
  std::mt19937 random(4);
  const SoftGolayDecoder decoder;
  for (int round = 0; round < 1000; ++round) {
    const int number = static_cast<int>(random() % kGolayNumbers);
    const GolayWord wrong = RandomPattern(random, 4);
    CellLikelihoods cells = CleanCells(number);
    for (int i = 0; i < kGolayBits; ++i) {
      if ((wrong >> i & 1U) != 0) cells[i] *= -0.5F;
    }
    const SoftGolayDecoding decoding = decoder.Decode(cells);
    ASSERT_EQ(decoding.number, number);
    ASSERT_EQ(decoding.disagreements, 4);
    ASSERT_GT(decoding.margin, 0.0F);
  }
}

TEST(SoftGolayDecoder, ReadsThroughAllSetsOfSevenErasedCells) {
  // All C(24, 7) sets. The code is linear, so the printed number does not matter.
  const SoftGolayDecoder decoder;
  const CellLikelihoods clean = CleanCells(2012);
  int patterns = 0, read = 0;
  GolayWord erased = (1U << 7) - 1;
  while (erased < 1U << kGolayBits) {
    const SoftGolayDecoding decoding = decoder.Decode(Erase(clean, erased));
    read += decoding.number == 2012 && decoding.margin > 0.0F ? 1 : 0;
    ++patterns;
    const GolayWord lowest = erased & -erased;
    const GolayWord ripple = erased + lowest;
    erased = ((erased ^ ripple) >> 2) / lowest | ripple;
  }
  EXPECT_EQ(patterns, 346'104);
  EXPECT_EQ(read, patterns);
}

struct ErasureRate {
  int erased;
  double readable;  ///< Share of the sets of `erased` cells that contain no codeword's support.
};

class ErasedCells : public ::testing::TestWithParam<ErasureRate> {};

TEST_P(ErasedCells, LeaveTheNumberReadableInTheirShareOfCases) {
  const auto [weight, readable] = GetParam();
  std::mt19937 random(5);
  const SoftGolayDecoder decoder;
  constexpr int kRounds = 20'000;
  int read = 0;
  for (int round = 0; round < kRounds; ++round) {
    const int number = static_cast<int>(random() % kGolayNumbers);
    const GolayWord erased = RandomPattern(random, weight);
    const SoftGolayDecoding decoding = decoder.Decode(Erase(CleanCells(number), erased));
    // The margin indicates reliability: above a threshold no number may be wrong.
    if (decoding.margin == 0.0F) continue;
    ASSERT_EQ(decoding.number, number);
    ++read;
  }
  const double deviation = std::sqrt(readable * (1.0 - readable) / kRounds);
  EXPECT_NEAR(static_cast<double>(read) / kRounds, readable, 5.0 * deviation);
}

// Counted over all C(24, e) sets of e cells.
INSTANTIATE_TEST_SUITE_P(EightToTwelve, ErasedCells,
                         ::testing::Values(ErasureRate{8, 1.0 - 759.0 / 735'471},
                                           ErasureRate{9, 1.0 - 12'144.0 / 1'307'504},
                                           ErasureRate{10, 1.0 - 91'080.0 / 1'961'256},
                                           ErasureRate{11, 1.0 - 425'040.0 / 2'496'144},
                                           ErasureRate{12, 1.0 - 1'313'116.0 / 2'704'156}),
                         [](const auto& rate) { return std::to_string(rate.param.erased); });

TEST(SoftGolayDecoder, ReadsOnlyNumbersInUse) {
  std::mt19937 random(6);
  SoftGolayDecoder decoder;
  const std::vector<int> in_use = {3000, 7, 7, 42, 4095, 0, 1999};
  ASSERT_TRUE(decoder.SetNumbersInUse(in_use));
  for (int round = 0; round < 300; ++round) {
    const CellLikelihoods cells = RandomCells(random);
    const SoftGolayDecoding decoding = decoder.Decode(cells);
    std::vector<std::pair<double, int>> ranking;
    for (const int n : {0, 7, 42, 1999, 3000, 4095}) ranking.emplace_back(Correlation(cells, n), n);
    std::sort(ranking.rbegin(), ranking.rend());
    double best_of_all = ranking[0].first;
    for (int n = 0; n < kGolayNumbers; ++n) {
      best_of_all = std::max(best_of_all, Correlation(cells, n));
    }
    EXPECT_NEAR(Correlation(cells, decoding.number), ranking[0].first, 4e-4);
    EXPECT_NEAR(Correlation(cells, *decoding.second_number), ranking[1].first, 4e-4);
    EXPECT_THAT(in_use, ::testing::Contains(decoding.number));
    EXPECT_THAT(in_use, ::testing::Contains(*decoding.second_number));
    EXPECT_NEAR(decoding.margin, ranking[0].first - ranking[1].first, 4e-4);
    EXPECT_NEAR(decoding.shortfall, best_of_all - ranking[0].first, 4e-4);
  }
}

TEST(SoftGolayDecoder, ReadsThroughMoreErasuresWhenFewNumbersAreInUse) {
  SoftGolayDecoder decoder;
  std::vector<int> fifty(50);
  std::iota(fifty.begin(), fifty.end(), 0);
  const auto share_read = [&] {
    std::mt19937 random(7);
    int read = 0;
    for (int round = 0; round < 2000; ++round) {
      const int number = static_cast<int>(random() % 50);
      const auto cells = Erase(CleanCells(number), RandomPattern(random, 12));
      read += decoder.Decode(cells).margin > 0.0F ? 1 : 0;
    }
    return read / 2000.0;
  };
  EXPECT_LT(share_read(), 0.56);
  ASSERT_TRUE(decoder.SetNumbersInUse(fifty));
  EXPECT_GT(share_read(), 0.97);
}

TEST(SoftGolayDecoder, SaysThatAForeignNumberScoresHigher) {
  SoftGolayDecoder decoder;
  ASSERT_TRUE(decoder.SetNumbersInUse(std::vector<int>{5}));
  const SoftGolayDecoding own = decoder.Decode(CleanCells(5));
  EXPECT_EQ(own.number, 5);
  EXPECT_EQ(own.second_number, std::nullopt);
  EXPECT_EQ(own.margin, std::numeric_limits<float>::infinity());
  EXPECT_EQ(own.shortfall, 0.0F);
  const SoftGolayDecoding foreign = decoder.Decode(CleanCells(6));
  EXPECT_EQ(foreign.number, 5);
  EXPECT_GE(foreign.shortfall, 2 * 8 * 4.0F);
}

TEST(SoftGolayDecoder, RefusesNumbersThatDoNotExistAndKeepsItsOwn) {
  SoftGolayDecoder decoder;
  ASSERT_TRUE(decoder.SetNumbersInUse(std::vector<int>{5}));
  const auto status = decoder.SetNumbersInUse(std::vector<int>{1, 4096});
  ASSERT_FALSE(status);
  EXPECT_THAT(status.error().Message(), HasSubstr("4096"));
  EXPECT_FALSE(decoder.SetNumbersInUse(std::vector<int>{-1}));
  EXPECT_EQ(decoder.Decode(CleanCells(1)).number, 5);
  ASSERT_TRUE(decoder.SetNumbersInUse({}));
  EXPECT_EQ(decoder.Decode(CleanCells(1)).number, 1);
}

TEST(SoftGolayDecoder, TakesNanForErasedAndInfinityForCertain) {
  const SoftGolayDecoder decoder;
  CellLikelihoods cells = CleanCells(77, std::numeric_limits<float>::infinity());
  cells[3] = cells[9] = std::numeric_limits<float>::quiet_NaN();
  const SoftGolayDecoding decoding = decoder.Decode(cells);
  EXPECT_EQ(decoding.number, 77);
  EXPECT_EQ(decoding.erasures, 2);
  EXPECT_FLOAT_EQ(decoding.score, 22 * 1000.0F);
}

TEST(SoftGolayDecoder, IsUndecidedWhereNothingIsVisible) {
  const SoftGolayDecoding decoding = SoftGolayDecoder().Decode(CellLikelihoods{});
  EXPECT_EQ(decoding.number, 0);
  EXPECT_EQ(decoding.second_number, 1);
  EXPECT_EQ(decoding.margin, 0.0F);
  EXPECT_EQ(decoding.agreement, 0.0F);
  EXPECT_EQ(decoding.erasures, kGolayBits);
}

TEST(SoftGolayDecoder, TellsPrintsFromRandomCellsByMarginAndAgreement) {
  // A hard decoder accepts 57 % of these random words as numbers.
  std::mt19937 random(8);
  std::normal_distribution<float> clutter(0.0F, 4.0F), noise(0.0F, 1.0F);
  const SoftGolayDecoder decoder;
  int random_accepted = 0, markers_accepted = 0;
  constexpr int kRounds = 20'000;
  const auto accepts = [&](const CellLikelihoods& cells) {
    const SoftGolayDecoding decoding = decoder.Decode(cells);
    return decoding.margin > 30.0F && decoding.agreement > 0.85F;
  };
  for (int round = 0; round < kRounds; ++round) {
    CellLikelihoods cells;
    for (float& cell : cells) cell = clutter(random);
    random_accepted += accepts(cells) ? 1 : 0;
    cells = CleanCells(static_cast<int>(random() % kGolayNumbers));
    for (float& cell : cells) cell += noise(random);
    markers_accepted += accepts(cells) ? 1 : 0;
  }
  EXPECT_LT(random_accepted, 0.002 * kRounds);
  EXPECT_GT(markers_accepted, 0.999 * kRounds);
}

}  // namespace
}  // namespace pleinair::tracker
