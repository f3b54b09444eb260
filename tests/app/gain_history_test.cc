#include "app/gain_history.h"

#include <gtest/gtest.h>

namespace pleinair::app {
namespace {

constexpr LinearRgb kGain{0.002, 0.001, 0.003};

void Add(int count, const LinearRgb& gain, GainHistory* history) {
  for (int i = 0; i < count; ++i) history->Add(gain);
}

TEST(GainHistory, KeepsTheMedianOfTheLastFifteenReadings) {
  GainHistory history;
  EXPECT_TRUE(history.empty());
  history.Add(kGain);
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
  history.Add({3.0, 1.0, 2.0});
  history.Add({1.0, 2.0, 3.0});
  history.Add({2.0, 3.0, 1.0});
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

}  // namespace
}  // namespace pleinair::app
