#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "devices/films/libav_pointer.h"
#include "devices/recordings/video_file.h"
#include "export/images/video_writer.h"
#include "tests/devices/films/made_film.h"
#include "tests/devices/films/shown_frames.h"
#include "tests/temporary_folder.h"

namespace pleinair::exports {
namespace {

using ::testing::HasSubstr;

struct SoundPacket {
  double time_s = 0.0;
  std::string bytes;
};

std::vector<SoundPacket> SoundOf(const std::filesystem::path& file) {
  AVFormatContext* opened = nullptr;
  std::vector<SoundPacket> packets;
  if (avformat_open_input(&opened, file.c_str(), nullptr, nullptr) < 0) return packets;
  const devices::LibavPointer<AVFormatContext> format(opened);
  avformat_find_stream_info(opened, nullptr);
  const int track = av_find_best_stream(opened, AVMEDIA_TYPE_AUDIO, -1, -1, nullptr, 0);
  const devices::LibavPointer<AVPacket> packet(av_packet_alloc());
  while (track >= 0 && av_read_frame(opened, packet.get()) >= 0) {
    if (packet->stream_index == track) {
      packets.push_back(
          {static_cast<double>(packet->pts) * av_q2d(opened->streams[track]->time_base),
           std::string(reinterpret_cast<const char*>(packet->data), packet->size)});
    }
    av_packet_unref(packet.get());
  }
  return packets;
}

/// Two seconds of a film with a pause of 0.2 s and sound.
tests::MadeFilm FilmWithSound() {
  tests::MadeFilm film;
  film.ticks = tests::NtscTicks(60);
  for (std::size_t i = 30; i < film.ticks.size(); ++i) film.ticks[i] += 6'000;
  film.sound_encoder = "aac";
  film.sound_s = 2.2;
  return film;
}

struct Copied {
  std::vector<std::int64_t> stamps_ns;
  std::string why_silent;
};

/// Writes the frames from `first` on with the film's sound.
Copied Copy(const std::filesystem::path& film, const std::filesystem::path& to, std::size_t first) {
  auto video = devices::OpenVideo(film, {});
  EXPECT_TRUE(video) << video.error().Message();
  const auto frames = tests::ReadAll(*video->frames);
  VideoWriter::Options options{64, 48, video->frame_rate_hz, video->curve, {}};
  options.sound =
      CopiedSound{film, *video->start_s + static_cast<double>(frames[first].timestamp_ns) * 1e-9};
  auto writer = VideoWriter::Create(to, options);
  EXPECT_TRUE(writer) << writer.error().Message();
  Copied copied{{}, (*writer)->why_silent()};
  for (std::size_t i = first; i < frames.size(); ++i) {
    copied.stamps_ns.push_back(frames[i].timestamp_ns - frames[first].timestamp_ns);
    EXPECT_TRUE((*writer)->Add(frames[i].rgb.view(), frames[i].timestamp_ns));
  }
  EXPECT_TRUE((*writer)->Finish());
  return copied;
}

TEST(SoundCopy, KeepsPacketsAndTheirTimesBesideTheImages) {
  const tests::TemporaryFolder folder;
  tests::WriteFilm(folder / "film.mov", FilmWithSound(),
                   [](AVFrame* frame, int i) { tests::FillPlanes(frame, 40 + i, 128, 128); });
  const auto before = SoundOf(folder / "film.mov");
  ASSERT_GT(before.size(), 90U);
  const Copied copied = Copy(folder / "film.mov", folder / "copy.mp4", 0);
  EXPECT_EQ(copied.why_silent, "");
  const auto after = SoundOf(folder / "copy.mp4");
  // All that begins before the end of the last frame.
  ASSERT_GE(after.size() + 6, before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].bytes, before[i].bytes) << i;
    EXPECT_NEAR(after[i].time_s, before[i].time_s, 1e-3) << i;
  }
  const auto video = devices::OpenVideo(folder / "copy.mp4", {});
  ASSERT_TRUE(video) << video.error().Message();
  const auto frames = tests::ReadAll(*video->frames);
  ASSERT_EQ(frames.size(), copied.stamps_ns.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(frames[i].timestamp_ns - copied.stamps_ns[i]), 0.0, 1e6) << i;
  }
}

TEST(SoundCopy, BeginsWithTheFirstImage) {
  const tests::TemporaryFolder folder;
  tests::WriteFilm(folder / "film.mov", FilmWithSound(),
                   [](AVFrame* frame, int i) { tests::FillPlanes(frame, 40 + i, 128, 128); });
  const auto before = SoundOf(folder / "film.mov");
  Copy(folder / "film.mov", folder / "late.mp4", 30);
  const double start_s = (30 * 1001 + 6000) / 30'000.0;
  const auto after = SoundOf(folder / "late.mp4");
  ASSERT_FALSE(after.empty());
  const auto same = std::find_if(before.begin(), before.end(), [&](const SoundPacket& packet) {
    return packet.bytes == after[3].bytes && packet.time_s > start_s - 0.1;
  });
  ASSERT_NE(same, before.end());
  EXPECT_NEAR(after[3].time_s, same->time_s - start_s, 1e-3);
  EXPECT_LT(after.front().time_s, 0.03);
}

TEST(SoundCopy, SaysWhatMp4DoesNotHold) {
  const tests::TemporaryFolder folder;
  tests::MadeFilm film = FilmWithSound();
  film.sound_encoder = "pcm_s16le";
  tests::WriteFilm(folder / "film.mov", film,
                   [](AVFrame* frame, int i) { tests::FillPlanes(frame, 40 + i, 128, 128); });
  EXPECT_THAT(Copy(folder / "film.mov", folder / "copy.mp4", 0).why_silent,
              HasSubstr("coded as pcm_s16le"));
  EXPECT_TRUE(SoundOf(folder / "copy.mp4").empty());
  film.sound_encoder.clear();
  tests::WriteFilm(folder / "film.mov", film,
                   [](AVFrame* frame, int i) { tests::FillPlanes(frame, 40 + i, 128, 128); });
  EXPECT_EQ(Copy(folder / "film.mov", folder / "copy.mp4", 0).why_silent, "");
}

}  // namespace
}  // namespace pleinair::exports
