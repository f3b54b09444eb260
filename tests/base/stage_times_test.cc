#include "base/stage_times.h"

#include <gtest/gtest.h>

namespace pleinair {
namespace {

TEST(StageTimes, GivesMedianAndNinetyFifthPercentByNearestRank) {
  StageTimes times;
  for (int i = 100; i >= 1; --i) times.Add("track", i);
  times.Add("compose", 7);
  const auto summary = times.Summarize();
  ASSERT_EQ(summary.size(), 2U);
  EXPECT_EQ(summary[0].stage, "track");
  EXPECT_EQ(summary[0].runs, 100U);
  EXPECT_EQ(summary[0].median_ms, 50);
  EXPECT_EQ(summary[0].p95_ms, 95);
  EXPECT_EQ(summary[1].median_ms, 7);
}

}  // namespace
}  // namespace pleinair
