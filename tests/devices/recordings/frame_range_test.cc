#include "devices/recordings/frame_range.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "devices/recordings/recording.h"
#include "devices/recordings/video_file.h"
#include "tests/devices/films/made_film.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FrameRanges : public ::testing::Test {
 protected:
  FrameRanges() {
    tests::MadeFilm film;
    film.ticks = tests::NtscTicks(30);
    for (std::size_t i = 10; i < film.ticks.size(); ++i) film.ticks[i] += 30'000;  // A second.
    tests::WriteFilm(folder_ / "film.mov", film,
                     [](AVFrame* frame, int i) { tests::FillPlanes(frame, 40 + i, 128, 128); });
  }

  std::unique_ptr<FrameSource> Limited(FrameRange range) const {
    auto video = OpenVideo(folder_ / "film.mov", {});
    EXPECT_TRUE(video) << video.error().Message();
    return LimitFrames(std::move(video->frames), range, "film.mov");
  }

  static std::vector<std::int64_t> Indices(FrameSource& source) {
    std::vector<std::int64_t> indices;
    for (;;) {
      const auto frame = source.Next();
      EXPECT_TRUE(frame) << frame.error().Message();
      if (!frame || !*frame) return indices;
      indices.push_back((*frame)->index);
      EXPECT_NEAR((*frame)->grey(5, 5),
                  (40.0 + static_cast<double>((*frame)->index) - 16) * 255 / 219, 2);
    }
  }

  const tests::TemporaryFolder folder_;
};

TEST_F(FrameRanges, OneFrameIsTheSameAsInTheWhole) {
  const auto source = Limited({17, {}, {}});
  EXPECT_EQ(source->FrameCount(), 1);
  EXPECT_THAT(Indices(*source), ElementsAre(17));
}

TEST_F(FrameRanges, TimesAreThoseOfTheFilm) {
  // Frame 9 is at 0.3 s, frame 10 at 1.334 s.
  const auto source = Limited({{}, 300'300'000, 1'368'000'000});
  EXPECT_EQ(source->FrameCount(), 3);
  EXPECT_THAT(Indices(*source), ElementsAre(9, 10, 11));
  EXPECT_THAT(Indices(*Limited({{}, 1'960'000'000, {}})), ElementsAre(29));
  EXPECT_THAT(Indices(*Limited({{}, {}, 40'000'000})), ElementsAre(0, 1));
  EXPECT_EQ(Indices(*Limited({})).size(), 30U);
}

TEST_F(FrameRanges, WithoutFramesAreAnError) {
  const auto message = [&](FrameRange range) {
    const auto frame = Limited(range)->Next();
    return frame ? std::string() : frame.error().Message();
  };
  EXPECT_THAT(message({30, {}, {}}), HasSubstr("film.mov: has no frame 30: it has 30"));
  EXPECT_THAT(message({{}, 400'000'000, 1'000'000'000}), HasSubstr("from 0.4 s to 1 s"));
  EXPECT_THAT(message({{}, 9'000'000'000, {}}), HasSubstr("from 9 s"));
}

TEST(Still, IsARecordingOfOneFrame) {
  const tests::TemporaryFolder folder;
  folder.Copy(tests::Courtyard() / "frames/0003.jpg", "photo.jpg");
  RecordingOptions options;
  options.calibration = tests::Courtyard() / "recording.json";
  const auto recording = OpenRecording(folder / "photo.jpg", options);
  ASSERT_TRUE(recording) << recording.error().Message();
  EXPECT_EQ(recording->frames->FrameCount(), 1);
  const auto frame = recording->frames->Next();
  ASSERT_TRUE(frame && *frame);
  EXPECT_EQ((*frame)->timestamp_ns, 0);
  EXPECT_EQ((*frame)->rgb.width(), recording->camera.width);
  EXPECT_FALSE(recording->frames->Next()->has_value());
}

}  // namespace
}  // namespace pleinair::devices
