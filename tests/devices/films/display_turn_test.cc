#include "devices/films/display_turn.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "devices/recordings/video_file.h"
#include "tests/devices/films/made_film.h"
#include "tests/devices/films/shown_frames.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::HasSubstr;
using tests::MadeFilm;

// Four quarters of the stored image: 60 and 100 above, 140 and 180 below.
void DrawQuarters(AVFrame* frame, int /*i*/) {
  tests::FillPlanes(frame, 128, 128, 128);
  for (int y = 0; y < frame->height; ++y) {
    for (int x = 0; x < frame->width; ++x) {
      const int quarter = (x >= frame->width / 2 ? 1 : 0) + (y >= frame->height / 2 ? 2 : 0);
      frame->data[0][y * frame->linesize[0] + x] = static_cast<std::uint8_t>(60 + 40 * quarter);
    }
  }
}

/// The quarters of a shown image in reading order, as 0 to 3 of the stored one.
std::array<int, 4> QuartersOf(const Frame& frame) {
  std::array<int, 4> quarters{};
  for (int i = 0; i < 4; ++i) {
    const int x = frame.grey.width() * (i % 2 == 0 ? 1 : 3) / 4;
    const int y = frame.grey.height() * (i < 2 ? 1 : 3) / 4;
    const double luma = frame.grey(x, y) * 219.0 / 255.0 + 16.0;
    quarters[i] = static_cast<int>(std::lround((luma - 60.0) / 40.0));
  }
  return quarters;
}

TEST(DisplayTurn, AppliesTheEightSymmetries) {
  struct Case {
    std::array<double, 4> matrix;
    std::array<int, 4> quarters;
    int clockwise_deg;
    bool mirrored;
  };
  const Case cases[] = {
      {{1, 0, 0, 1}, {0, 1, 2, 3}, 0, false},     {{0, 1, -1, 0}, {2, 0, 3, 1}, 90, false},
      {{-1, 0, 0, -1}, {3, 2, 1, 0}, 180, false}, {{0, -1, 1, 0}, {1, 3, 0, 2}, 270, false},
      {{-1, 0, 0, 1}, {1, 0, 3, 2}, 0, true},     {{1, 0, 0, -1}, {2, 3, 0, 1}, 180, true},
      {{0, 1, 1, 0}, {0, 2, 1, 3}, 90, true},     {{0, -1, -1, 0}, {3, 1, 2, 0}, 270, true}};
  const tests::TemporaryFolder folder;
  for (const Case& each : cases) {
    MadeFilm film;
    film.ticks = {0};
    film.display = each.matrix;
    tests::WriteFilm(folder / "film.mov", film, DrawQuarters);
    const auto video = OpenVideo(folder / "film.mov", {});
    ASSERT_TRUE(video) << video.error().Message();
    const auto frames = tests::ReadAll(*video->frames);
    ASSERT_EQ(frames.size(), 1U);
    const bool portrait = each.matrix[0] == 0;
    EXPECT_EQ(video->size, (ImageSize{portrait ? 48 : 64, portrait ? 64 : 48}));
    EXPECT_EQ(frames[0].rgb.width(), video->size.width);
    EXPECT_EQ(QuartersOf(frames[0]), each.quarters);
    std::array<std::int32_t, 9> matrix{};
    matrix[0] = static_cast<std::int32_t>(each.matrix[0] * 65536);
    matrix[1] = static_cast<std::int32_t>(each.matrix[1] * 65536);
    matrix[3] = static_cast<std::int32_t>(each.matrix[2] * 65536);
    matrix[4] = static_cast<std::int32_t>(each.matrix[3] * 65536);
    const auto turn = DisplayTurn::FromMatrix(matrix, "film");
    ASSERT_TRUE(turn);
    EXPECT_EQ(turn->clockwise_deg(), each.clockwise_deg);
    EXPECT_EQ(turn->mirrored(), each.mirrored);
  }
}

TEST(DisplayTurn, RefusesOtherAnglesAndScales) {
  const double s = std::sqrt(0.5);
  const tests::TemporaryFolder folder;
  for (const std::array<double, 4>& matrix :
       {std::array<double, 4>{s, s, -s, s}, std::array<double, 4>{2, 0, 0, 2},
        std::array<double, 4>{1, 0.5, 0, 1}, std::array<double, 4>{1, 1, -1, 1}}) {
    MadeFilm film;
    film.ticks = {0};
    film.display = matrix;
    tests::WriteFilm(folder / "film.mov", film, DrawQuarters);
    const auto video = OpenVideo(folder / "film.mov", {});
    ASSERT_FALSE(video);
    EXPECT_THAT(video.error().Message(), HasSubstr("multiple of 90 degrees"));
    EXPECT_THAT(video.error().Message(), HasSubstr("film.mov"));
  }
}

}  // namespace
}  // namespace pleinair::devices
