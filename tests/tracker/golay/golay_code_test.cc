#include "tracker/golay/golay_code.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <random>
#include <vector>

namespace pleinair::tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

constexpr GolayWord kAllCells = (1U << kGolayBits) - 1;

/// Calls `visit` with every word of 24 bits that has `weight` ones, in rising order.
template <typename Visit>
void ForEachPattern(int weight, Visit visit) {
  // Gosper's hack (HAKMEM 175): the next larger number with as many ones.
  GolayWord pattern = (1U << weight) - 1;
  while (pattern <= kAllCells) {
    visit(pattern);
    if (pattern == 0) return;
    const GolayWord lowest = pattern & -pattern;
    const GolayWord ripple = pattern + lowest;
    pattern = ((pattern ^ ripple) >> 2) / lowest | ripple;
  }
}

// Zero, all ones, and words that use every row of the generator.
constexpr int kSampleNumbers[] = {0, 4095, 1, 17, 1024, 2730, 1365, 3141};

TEST(GolayCode, HasTheWeightEnumeratorOfTheExtendedGolayCode) {
  std::map<int, int> words_of_weight;
  for (int n = 0; n < kGolayNumbers; ++n) ++words_of_weight[std::popcount(EncodeGolay(n))];
  // MacWilliams & Sloane 1977, ch. 2, Fig. 2.18.
  EXPECT_THAT(words_of_weight,
              ElementsAre(Pair(0, 1), Pair(8, 759), Pair(12, 2576), Pair(16, 759), Pair(24, 1)));
}

TEST(GolayCode, IsLinear) {
  // So that all statements about errors and distances carry over from one word to all.
  for (int a = 0; a < kGolayNumbers; a += 7) {
    for (int b = 0; b < kGolayNumbers; b += 5) {
      ASSERT_EQ(EncodeGolay(a) ^ EncodeGolay(b), EncodeGolay(a ^ b));
    }
  }
}

TEST(GolayCode, KeepsAnyTwoWordsEightBitsApart) {
  std::vector<GolayWord> words;
  for (int n = 0; n < kGolayNumbers; ++n) words.push_back(EncodeGolay(n));
  int least = kGolayBits;
  for (int a = 0; a < kGolayNumbers; ++a) {
    for (int b = 0; b < a; ++b) least = std::min(least, std::popcount(words[a] ^ words[b]));
  }
  EXPECT_EQ(least, 8);
}

TEST(GolayCode, CarriesTheNumberInItsLowTwelveBits) {
  for (int n = 0; n < kGolayNumbers; ++n) ASSERT_EQ(EncodeGolay(n) & 0xFFFU, n);
}

TEST(GolayCode, GivesTheFrozenWords) {
  // Prints out in the world carry these: they may never change.
  EXPECT_EQ(EncodeGolay(1), 0xA3B001U);
  EXPECT_EQ(EncodeGolay(2048), 0x7FF800U);
  EXPECT_EQ(EncodeGolay(4095), 0xFFFFFFU);
  EXPECT_EQ(CodewordOfNumber(0), 0xAAA555U);
  EXPECT_EQ(CodewordOfNumber(17), 0xD32544U);
}

// The code is linear and the decoder looks only at the syndrome, which errors alone decide; eight
// words instead of one guard against a decoder that lost that property.
TEST(HardGolayDecoder, CorrectsEveryPatternOfThreeErrorsOrLess) {
  for (const int number : kSampleNumbers) {
    const GolayWord word = EncodeGolay(number);
    int patterns = 0;
    for (int errors = 0; errors <= 3; ++errors) {
      ForEachPattern(errors, [&](GolayWord pattern) {
        const auto decoding = DecodeGolay(word ^ pattern);
        ASSERT_TRUE(decoding) << "number " << number << ", errors " << pattern;
        ASSERT_EQ(decoding->number, number) << "errors " << pattern;
        ASSERT_EQ(decoding->corrected_bits, errors) << "errors " << pattern;
        ++patterns;
      });
    }
    EXPECT_EQ(patterns, 2325);
  }
}

TEST(HardGolayDecoder, RefusesEveryPatternOfFourErrors) {
  for (const int number : kSampleNumbers) {
    const GolayWord word = EncodeGolay(number);
    ForEachPattern(4, [&](GolayWord pattern) {
      ASSERT_FALSE(DecodeGolay(word ^ pattern)) << "number " << number << ", errors " << pattern;
    });
  }
}

TEST(HardGolayDecoder, IgnoresBitsAboveTheTwentyFourth) {
  EXPECT_EQ(DecodeGolay(EncodeGolay(1234) | 0xFF000000U)->number, 1234);
}

TEST(HardGolayDecoder, AcceptsMoreThanHalfOfAllRandomWords) {
  // Which is why a number found is no proof of a marker: the soft decoder's margin must be it.
  std::mt19937 random(1);
  int accepted = 0;
  constexpr int kWords = 200'000;
  for (int i = 0; i < kWords; ++i) accepted += DecodeGolay(random() & kAllCells) ? 1 : 0;
  // 2325 / 4096; the standard deviation of the share is 0.0011.
  EXPECT_NEAR(static_cast<double>(accepted) / kWords, 0.5676, 0.005);
}

TEST(CodewordOfNumber, IsDecodedToItsNumber) {
  for (int n = 0; n < kGolayNumbers; ++n) {
    const auto decoding = DecodeCodeword(CodewordOfNumber(n));
    ASSERT_TRUE(decoding);
    ASSERT_EQ(decoding->number, n);
    ASSERT_EQ(decoding->corrected_bits, 0);
  }
}

TEST(CodewordOfNumber, LiesFourBitsOrMoreFromAUniformPatch) {
  int fewest = kGolayBits, most = 0;
  for (int n = 0; n < kGolayNumbers; ++n) {
    fewest = std::min(fewest, std::popcount(CodewordOfNumber(n)));
    most = std::max(most, std::popcount(CodewordOfNumber(n)));
  }
  EXPECT_EQ(fewest, 4);
  EXPECT_EQ(most, 20);
  EXPECT_FALSE(DecodeCodeword(0));
  EXPECT_FALSE(DecodeCodeword(kAllCells));
}

TEST(CodewordOfNumber, OfNumberZeroIsTheChequerboardRoundTheCentre) {
  int cell = 0;
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 5; ++column) {
      if (row == 2 && column == 2) continue;
      EXPECT_EQ(CodewordOfNumber(0) >> cell & 1U, (row + column) % 2 == 0 ? 1U : 0U)
          << row << ", " << column;
      ++cell;
    }
  }
}

using GolayCodeDeathTest = ::testing::Test;

TEST(GolayCodeDeathTest, HasNoWordForANumberOutOfRange) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(EncodeGolay(4096), "CHECK failed");
  EXPECT_DEATH(EncodeGolay(-1), "CHECK failed");
}

}  // namespace
}  // namespace pleinair::tracker
