#include "session/light_frames.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pleinair::session {
namespace {

/// Every third frame has a pose; frames are `seconds` apart.
std::vector<Observation> Path(std::int64_t size, std::int64_t seconds) {
  std::vector<Observation> path(static_cast<std::size_t>(size));
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

}  // namespace
}  // namespace pleinair::session
