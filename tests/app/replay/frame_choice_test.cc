#include "app/replay/frame_choice.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

namespace pleinair::app {
namespace {

/// Every third frame has a pose, `seconds` apart from the next.
std::vector<session::Observation> Path(std::int64_t size, std::int64_t seconds) {
  std::vector<session::Observation> path(static_cast<std::size_t>(size));
  for (std::int64_t i = 0; i < size; ++i) {
    path[static_cast<std::size_t>(i)].frame_index = 3 * i;
    path[static_cast<std::size_t>(i)].timestamp_ns = i * seconds * 1'000'000'000;
  }
  return path;
}

TEST(LightFrames, SpreadOverAShortPath) {
  EXPECT_EQ(LightFrames(Path(16, 1)), (std::vector<std::size_t>{1, 3, 5, 7, 9, 11, 13, 15}));
  EXPECT_EQ(LightFrames(Path(3, 1)), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(LightFrames({}).empty());
}

TEST(LightFrames, KeepToTheMinuteAboutTheMiddleOfALongPath) {
  const std::vector<std::size_t> chosen = LightFrames(Path(1000, 10));
  EXPECT_EQ(chosen, (std::vector<std::size_t>{497, 498, 499, 500, 501, 502, 503}));
}

TEST(ReportFrames, AreOfThoseWithAPoseWhereThereAreAny) {
  EXPECT_EQ(ReportFrames(Path(8, 1), 100), (std::set<std::int64_t>{3, 9, 15, 21}));
  EXPECT_EQ(ReportFrames({}, 80), (std::set<std::int64_t>{10, 30, 50, 70}));
  EXPECT_EQ(ReportFrames({}, 2), (std::set<std::int64_t>{0, 1}));
  EXPECT_TRUE(ReportFrames({}, 0).empty());
}

}  // namespace
}  // namespace pleinair::app
