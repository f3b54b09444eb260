#include <gtest/gtest.h>

#include "app/options/picture_size.h"
#include "app/terminal/progress_bar.h"

namespace pleinair::app {
namespace {

TEST(ParsePictureSize, TakesTwoNumbersWithACross) {
  const auto size = ParsePictureSize("--size", "1280x720");
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 1280);
  EXPECT_EQ(size->height, 720);
}

TEST(ParsePictureSize, RefusesAnythingElse) {
  for (const char* text : {"", "x", "1280", "1280x", "x720", "1280x720x3", "-64x64", "0x0", "15x15",
                           "99999999999x20", "1280 x 720", "20000x16"}) {
    EXPECT_FALSE(ParsePictureSize("--size", text)) << text;
  }
}

TEST(ProgressBar, ShowsShareAndTimeToGo) {
  EXPECT_EQ(ProgressBar::Line("Composing", 30, 90, 10.0),
            "Composing [##########....................] 33 % of 90 frames, 20 s to go");
  EXPECT_EQ(ProgressBar::Line("Composing", 7, std::nullopt, 1.0), "Composing 7 frames");
  EXPECT_EQ(ProgressBar::Line("Measuring", 0, std::nullopt, 0.0, "rounds"), "Measuring");
  EXPECT_EQ(ProgressBar::Line("Measuring", 1, std::nullopt, 0.0, "rounds"), "Measuring 1 round");
}

}  // namespace
}  // namespace pleinair::app
