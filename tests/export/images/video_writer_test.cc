#include "export/images/video_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "devices/recordings/video_file.h"
#include "export/images/image_writer.h"

namespace pleinair::exports {
namespace {

namespace fs = std::filesystem;

RgbImage Gradient(int width, int height, int shift) {
  RgbImage image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image(x, y, 0) = static_cast<std::uint8_t>(x + shift);
      image(x, y, 1) = static_cast<std::uint8_t>(y * 2);
      image(x, y, 2) = static_cast<std::uint8_t>(x * y + shift);
    }
  }
  return image;
}

std::string Bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string Encode(const fs::path& file, int width, int height) {
  auto writer = VideoWriter::Create(file, {width, height, 29.97});
  EXPECT_TRUE(writer) << writer.error().Message();
  for (int i = 0; i < 12; ++i) {
    EXPECT_TRUE((*writer)->Add(Gradient(width, height, i).view(), i * 33'366'667LL));
  }
  EXPECT_TRUE((*writer)->Finish());
  return Bytes(file);
}

class WriterTest : public ::testing::Test {
 protected:
  WriterTest() {
    std::string pattern = (fs::temp_directory_path() / "pleinair-app-XXXXXX").string();
    root_ = mkdtemp(pattern.data());
  }
  ~WriterTest() override { fs::remove_all(root_); }
  fs::path root_;
};

TEST_F(WriterTest, VideoOfTheSameFramesHasTheSameBytes) {
  const std::string first = Encode(root_ / "a.mp4", 160, 96);
  EXPECT_GT(first.size(), 1000U);
  EXPECT_TRUE(first == Encode(root_ / "b.mp4", 160, 96));
}

TEST_F(WriterTest, VideoTakesOddSizes) {
  EXPECT_GT(Encode(root_ / "odd.mp4", 161, 97).size(), 1000U);
}

struct Timing {
  double rate_hz;
  std::int64_t period_ns;
  std::int64_t first_ns;
};

TEST_F(WriterTest, VideoKeepsTheTimesOfSlowFramesAndOfStampsBeforeZero) {
  for (const auto& [rate_hz, period_ns, first_ns] :
       {Timing{1.0 / 300.0, 300'000'000'000, 0}, Timing{0.004, 250'000'000'000, 0},
        Timing{0.5, 2'000'000'000, -5'000'000'000}}) {
    const fs::path file = root_ / "slow.mp4";
    auto writer = VideoWriter::Create(file, {64, 48, rate_hz});
    ASSERT_TRUE(writer) << rate_hz << ": " << writer.error().Message();
    for (int i = 0; i < 4; ++i) {
      const auto added = (*writer)->Add(Gradient(64, 48, i).view(), first_ns + i * period_ns);
      ASSERT_TRUE(added) << added.error().Message();
    }
    ASSERT_TRUE((*writer)->Finish());
    const auto video = devices::OpenVideo(file, {{64, 48}, {}, {}, {}});
    ASSERT_TRUE(video) << video.error().Message();
    EXPECT_NEAR(video->frame_rate_hz / rate_hz, 1.0, 1e-3);
    EXPECT_EQ(video->frames->FrameCount(), 4);
  }
}

TEST_F(WriterTest, WhatLibavRefusesIsNoFaultOfTheFile) {
  // One frame in four months: beyond MP4's time range.
  auto writer = VideoWriter::Create(root_ / "slow.mp4", {64, 48, 1e-7});
  ASSERT_TRUE(writer);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE((*writer)->Add(Gradient(64, 48, i).view(), i * 10'000'000'000'000'000));
  }
  const auto finished = (*writer)->Finish();
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error().kind, ErrorKind::kSystem);
  EXPECT_NE(finished.error().what.find("cannot encode"), std::string::npos);
}

TEST_F(WriterTest, VideoTakesTheFastestRates) {
  for (const double rate_hz : {29970.03, 1e5}) {
    auto writer = VideoWriter::Create(root_ / "fast.mp4", {64, 48, rate_hz});
    ASSERT_TRUE(writer) << rate_hz;
    ASSERT_TRUE((*writer)->Add(Gradient(64, 48, 0).view(), 0));
    EXPECT_TRUE((*writer)->Finish());
  }
}

TEST_F(WriterTest, VideoIntoAMissingFolderIsAnInputErrorThatNamesTheFile) {
  const auto writer = VideoWriter::Create(root_ / "none/a.mp4", {64, 64, 25});
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().kind, ErrorKind::kInput);
  EXPECT_EQ(writer.error().where, (root_ / "none/a.mp4").string());
}

TEST_F(WriterTest, PngOfTheSamePictureHasTheSameBytes) {
  ASSERT_TRUE(WritePng(root_ / "a.png", Gradient(31, 17, 0).view()));
  ASSERT_TRUE(WritePng(root_ / "b.png", Gradient(31, 17, 0).view()));
  EXPECT_TRUE(Bytes(root_ / "a.png") == Bytes(root_ / "b.png"));
}

TEST(WritePng, OntoAFullDiskIsASystemError) {
  // More than the stream's buffer, so that the failure occurs while writing.
  const auto written = WritePng("/dev/full", Gradient(256, 256, 3).view());
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::kSystem);
  EXPECT_NE(written.error().what.find("No space left"), std::string::npos);
}

}  // namespace
}  // namespace pleinair::exports
