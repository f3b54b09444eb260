#include "app/replay/report_frames.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <vector>

namespace pleinair::app {
namespace {

/// Every third frame has a pose; frames are `seconds` apart.
std::vector<session::Observation> Path(std::int64_t size, std::int64_t seconds) {
  std::vector<session::Observation> path(static_cast<std::size_t>(size));
  for (std::int64_t i = 0; i < size; ++i) {
    path[static_cast<std::size_t>(i)].frame_index = 3 * i;
    path[static_cast<std::size_t>(i)].timestamp_ns = i * seconds * 1'000'000'000;
  }
  return path;
}

TEST(ReportFrames, AreOfThoseWithAPoseWhereThereAreAny) {
  EXPECT_EQ(ReportFrames(Path(8, 1), 0, 100), (std::set<std::int64_t>{3, 9, 15, 21}));
  EXPECT_EQ(ReportFrames({}, 0, 80), (std::set<std::int64_t>{10, 30, 50, 70}));
  EXPECT_EQ(ReportFrames({}, 0, 2), (std::set<std::int64_t>{0, 1}));
  EXPECT_EQ(ReportFrames({}, 45, 1), (std::set<std::int64_t>{45}));
  EXPECT_TRUE(ReportFrames({}, 0, 0).empty());
}

}  // namespace
}  // namespace pleinair::app
