#include "compositor/photometry/gain_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pleinair::compositor {
namespace {

constexpr LinearRgb kGain{0.002, 0.001, 0.003};
constexpr LinearRgb kError{0.01, 0.02, 0.03};  // Of each reading, relative.

void Add(int count, const LinearRgb& gain, GainHistory* history) {
  for (int i = 0; i < count; ++i) history->Add(gain, kError);
}

TEST(GainHistory, KeepsTheMedianOfTheLastFifteenReadings) {
  GainHistory history;
  EXPECT_TRUE(history.empty());
  history.Add(kGain, kError);
  EXPECT_FALSE(history.empty());
  EXPECT_DOUBLE_EQ(history.Gain().r, kGain.r);
  Add(14, kGain, &history);
  Add(7, kGain * 2.0, &history);
  EXPECT_DOUBLE_EQ(history.Gain().g, kGain.g);
  Add(1, kGain * 2.0, &history);
  EXPECT_DOUBLE_EQ(history.Gain().g, 2.0 * kGain.g);
}

TEST(GainHistory, TakesEachChannelByItself) {
  GainHistory history;
  history.Add({3.0, 1.0, 2.0}, kError);
  history.Add({1.0, 2.0, 3.0}, kError);
  history.Add({2.0, 3.0, 1.0}, kError);
  EXPECT_DOUBLE_EQ(history.Gain().r, 2.0);
  EXPECT_DOUBLE_EQ(history.Gain().g, 2.0);
  EXPECT_DOUBLE_EQ(history.Gain().b, 2.0);
}

TEST(GainHistory, TellsHowMuchTheGainChanged) {
  GainHistory history;
  EXPECT_DOUBLE_EQ(history.Change(), 1.0);
  Add(5, kGain, &history);
  EXPECT_DOUBLE_EQ(history.Change(), 1.0);
  // Three of five are the new light; of the channel that changed most, and back again.
  Add(3, {kGain.r, kGain.g / 2.5, kGain.b * 1.5}, &history);
  EXPECT_NEAR(history.Change(), 2.5, 1e-12);
  Add(20, kGain, &history);
  EXPECT_NEAR(history.Change(), 2.5, 1e-12);
}

TEST(GainHistory, IsNotMisledByAHandOrAHighlight) {
  GainHistory history;
  for (int i = 0; i < 10; ++i) {
    Add(2, kGain * (i % 2 == 0 ? 4.0 : 0.1), &history);
    Add(3, kGain, &history);
  }
  EXPECT_DOUBLE_EQ(history.Change(), 1.0);
  EXPECT_DOUBLE_EQ(history.Gain().b, kGain.b);
}

TEST(GainHistory, TellsHowCertainItsMedianIs) {
  GainHistory history;
  Add(1, kGain, &history);
  EXPECT_DOUBLE_EQ(history.Error().r, kError.r) << "a single reading's own";
  Add(14, kGain, &history);
  EXPECT_DOUBLE_EQ(history.Error().g, kError.g) << "frames share what is wrong of a print";
  // Five of fifteen above and five below by 8 %: a median deviation of 8 % in green alone.
  GainHistory scattered;
  for (int i = 0; i < 5; ++i) {
    for (const double off : {0.92, 1.0, 1.08}) {
      scattered.Add({kGain.r, kGain.g * off, kGain.b}, kError);
    }
  }
  EXPECT_DOUBLE_EQ(scattered.Error().r, kError.r);
  const double among = 0.08 * 1.4826 * 1.2533 / std::sqrt(15.0);
  EXPECT_NEAR(scattered.Error().g, std::hypot(kError.g, among), 1e-6);
}

}  // namespace
}  // namespace pleinair::compositor
