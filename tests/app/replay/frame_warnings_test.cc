#include "app/replay/frame_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pleinair::app {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(FrameWarnings, ReportEachThingOnceWithItsFrames) {
  FrameWarnings warnings;
  EXPECT_THAT(warnings.Sentences(), IsEmpty());
  warnings.Add(2, {"a marker is mirrored"});
  warnings.Add(3, {"a marker is mirrored", "a marker is mirrored", "another is torn"});
  warnings.Add(9, {"a marker is mirrored"});
  EXPECT_THAT(warnings.Sentences(),
              ElementsAre("In 3 frames, the first being 2, a marker is mirrored.",
                          "In frame 3 another is torn."));
}

TEST(FrameWarnings, StayFewWhereEachFrameSaysSomethingElse) {
  FrameWarnings warnings;
  for (int i = 0; i < 1000; ++i) warnings.Add(i, {"number " + std::to_string(i)});
  EXPECT_THAT(warnings.Sentences(), SizeIs(8));
}

}  // namespace
}  // namespace pleinair::app
