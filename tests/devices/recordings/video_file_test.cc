#include "devices/recordings/video_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/recordings/recording.h"
#include "tests/devices/films/made_film.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kFrames = 40;
constexpr const char* kLens =
    "image_size: [160, 120]\nK: [150, 0, 79.5, 0, 150, 59.5, 0, 0, 1]\nD: []\n";

// Frame i has the grey value 4 i, which shows order and number.
void WriteVideo(const std::filesystem::path& file, bool motion_jpeg = false) {
  tests::MadeFilm film;
  film.width = 160;
  film.height = 120;
  film.ticks_per_s = 25;
  for (int i = 0; i < kFrames; ++i) film.ticks.push_back(i);
  if (motion_jpeg) {
    film.encoder = "mjpeg";
    film.pixels = "yuvj420p";
    film.full_range = true;
  }
  tests::WriteFilm(file, film, [&](AVFrame* frame, int i) {
    tests::FillPlanes(frame, motion_jpeg ? 4 * i : 16 + 4 * i * 219 / 255, 128, 128);
  });
}

class Video : public ::testing::Test {
 protected:
  Video() {
    WriteVideo(folder_ / "film.mp4");
    options_.calibration = folder_.Write("lens.yaml", kLens);
  }

  // Reads all frames. Returns the error's message, or their number.
  static std::string ReadAll(const Result<Recording>& recording) {
    if (!recording) return "at opening: " + recording.error().Message();
    for (int i = 0;; ++i) {
      const Result<std::optional<Frame>> frame = recording->frames->Next();
      if (!frame) return frame.error().Message();
      if (!*frame) return std::to_string(i) + " frames";
    }
  }

  const tests::TemporaryFolder folder_;
  RecordingOptions options_;
};

TEST_F(Video, PlainFileOpensWithACalibration) {
  const Result<Recording> recording = OpenRecording(folder_ / "film.mp4", options_);
  ASSERT_TRUE(recording) << recording.error().Message();
  EXPECT_FALSE(recording->scene);
  EXPECT_NEAR(recording->frame_rate_hz, 25, 1e-9);
  EXPECT_EQ(recording->frames->FrameCount(), kFrames);
  for (int i = 0; i < kFrames; ++i) {
    const Result<std::optional<Frame>> frame = recording->frames->Next();
    ASSERT_TRUE(frame && *frame) << i;
    EXPECT_EQ((*frame)->index, i);
    EXPECT_EQ((*frame)->timestamp_ns, i * 40'000'000LL);
    EXPECT_NEAR((*frame)->grey(80, 60), 4 * i, 4) << i;
  }
  EXPECT_FALSE(recording->frames->Next()->has_value());
}

TEST_F(Video, FolderMayHaveAVideoInsteadOfPictures) {
  const char* json = R"({"frames": "film.mp4", "frame_count": 40, "frame_rate_hz": 25,
    "calibration": {"image_width": 160, "image_height": 120, "fx": 150, "fy": 150, "cx": 79.5,
                    "cy": 59.5}})";
  folder_.Write("recording.json", json);
  EXPECT_EQ(ReadAll(OpenRecording(folder_.path())), "40 frames");
  // The conventional file is used if the named folder does not exist.
  std::filesystem::rename(folder_ / "film.mp4", folder_ / "background.mp4");
  folder_.Write("recording.json", tests::Replaced(json, "film.mp4", "frames"));
  EXPECT_EQ(ReadAll(OpenRecording(folder_.path())), "40 frames");
  folder_.Write("recording.json",
                tests::Replaced(json, "\"frame_count\": 40", "\"frame_count\": 41"));
  EXPECT_THAT(ReadAll(OpenRecording(folder_.path())), HasSubstr("only 40 of 41 frames"));
}

TEST_F(Video, EndsWhereItsDescriptionEndsIt) {
  for (const std::size_t wanted : {9, 10, 20, 39, 40, 1000}) {
    VideoMetadata known;
    known.frame_count = 10;
    auto video = OpenVideo(folder_ / "film.mp4", known);
    ASSERT_TRUE(video) << video.error().Message();
    video->frames->SkipTo(static_cast<std::int64_t>(wanted));
    const Result<std::optional<Frame>> frame = video->frames->Next();
    ASSERT_TRUE(frame) << frame.error().Message();
    EXPECT_EQ(frame->has_value(), wanted == 9) << wanted;
  }
}

TEST_F(Video, CutShortAnywhereIsNoticedAtOpening) {
  WriteVideo(folder_ / "film.avi", /*motion_jpeg=*/true);
  EXPECT_EQ(ReadAll(OpenRecording(folder_ / "film.avi", options_)), "40 frames");
  WriteVideo(folder_ / "film.mkv");
  EXPECT_EQ(ReadAll(OpenRecording(folder_ / "film.mkv", options_)), "40 frames");
  for (const char* name : {"film.mp4", "film.avi", "film.mkv"}) {
    const std::string whole = tests::Content(folder_ / name);
    for (const std::size_t length : {whole.size() / 10, whole.size() / 2, whole.size() - 1}) {
      const std::filesystem::path part =
          folder_.Write(std::string("part_of_") + name, whole.substr(0, length));
      EXPECT_THAT(ReadAll(OpenRecording(part, options_)),
                  AllOf(HasSubstr("at opening: "), HasSubstr(name), HasSubstr("cut short")))
          << length;
    }
  }
}

// FLV states no length of the file, but those of its tags.
TEST_F(Video, CutShortWithinAFrameOfFlvIsNoticed) {
  WriteVideo(folder_ / "film.flv");
  EXPECT_EQ(ReadAll(OpenRecording(folder_ / "film.flv", options_)), "40 frames");
  const std::string whole = tests::Content(folder_ / "film.flv");
  const std::filesystem::path part =
      folder_.Write("part.flv", whole.substr(0, whole.size() * 2 / 3));
  EXPECT_THAT(ReadAll(OpenRecording(part, options_)),
              AllOf(HasSubstr("part.flv"), HasSubstr("cut short")));
}

TEST_F(Video, LengthsBeyondAllMeasureAreNoOverflow) {
  const std::string head(
      "\0\0\0\x10"
      "ftypisom\0\0\0\0"
      "\0\0\0\x01"
      "mdat",
      24);
  const std::filesystem::path file =
      folder_.Write("huge.mp4", head + std::string(8, '\xFF') + std::string(64, 'x'));
  EXPECT_THAT(ReadAll(OpenRecording(file, options_)), HasSubstr("cut short"));
}

TEST_F(Video, EmptyMissingOrSenselessFilesAreNamed) {
  EXPECT_THAT(ReadAll(OpenRecording(folder_.Write("empty.mp4", ""), options_)),
              AllOf(HasSubstr("empty.mp4"), HasSubstr("is empty")));
  EXPECT_THAT(ReadAll(OpenRecording(folder_.Write("words.mp4", std::string(5000, 'w')), options_)),
              HasSubstr("cannot be opened as a video"));
  EXPECT_THAT(ReadAll(OpenRecording(folder_ / "none.mp4", options_)), HasSubstr("none.mp4"));
}

TEST_F(Video, ShapeMustBeTheCalibrations) {
  options_.calibration =
      folder_.Write("other.yaml", tests::Replaced(kLens, "[160, 120]", "[320, 200]"));
  EXPECT_THAT(ReadAll(OpenRecording(folder_ / "film.mp4", options_)),
              AllOf(HasSubstr("160x120"), HasSubstr("320x200")));
}

TEST_F(Video, DecodesToTheSameBytesTwice) {
  const Result<Recording> a = OpenRecording(folder_ / "film.mp4", options_);
  const Result<Recording> b = OpenRecording(folder_ / "film.mp4", options_);
  ASSERT_TRUE(a && b);
  for (int i = 0; i < kFrames; ++i) {
    const Frame one = a->frames->Next()->value();
    const Frame other = b->frames->Next()->value();
    ASSERT_TRUE(std::equal(one.rgb.data(), one.rgb.data() + one.rgb.size(), other.rgb.data()));
  }
}

}  // namespace
}  // namespace pleinair::devices
