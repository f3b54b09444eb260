#include "tracker/golay/golay_code.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <vector>

namespace pleinair::tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(GolayCode, HasTheWeightEnumeratorOfTheExtendedGolayCode) {
  std::map<int, int> words_of_weight;
  for (int n = 0; n < kGolayNumbers; ++n) ++words_of_weight[std::popcount(EncodeGolay(n))];
  // MacWilliams & Sloane 1977, ch. 2, Fig. 2.18.
  EXPECT_THAT(words_of_weight,
              ElementsAre(Pair(0, 1), Pair(8, 759), Pair(12, 2576), Pair(16, 759), Pair(24, 1)));
}

TEST(GolayCode, IsLinear) {
  // Linearity: statements about errors and distances hold for every word.
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
  // Printed markers use these codewords: they must never change.
  EXPECT_EQ(EncodeGolay(1), 0xA3B001U);
  EXPECT_EQ(EncodeGolay(2048), 0x7FF800U);
  EXPECT_EQ(EncodeGolay(4095), 0xFFFFFFU);
  EXPECT_EQ(CodewordOfNumber(0), 0xAAA555U);
  EXPECT_EQ(CodewordOfNumber(17), 0xD32544U);
}

TEST(CodewordOfNumber, LiesFourBitsOrMoreFromAUniformPatch) {
  int fewest = kGolayBits, most = 0;
  for (int n = 0; n < kGolayNumbers; ++n) {
    fewest = std::min(fewest, std::popcount(CodewordOfNumber(n)));
    most = std::max(most, std::popcount(CodewordOfNumber(n)));
  }
  EXPECT_EQ(fewest, 4);
  EXPECT_EQ(most, 20);
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
