#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/films/film_stamps.h"
#include "devices/recordings/video_file.h"
#include "tests/devices/films/made_film.h"
#include "tests/devices/films/shown_frames.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using tests::MadeFilm;

/// 24 frames at 29.97 Hz, of which the tenth is shown for 0.2 s longer.
std::vector<std::int64_t> PausedTicks() {
  std::vector<std::int64_t> ticks = tests::NtscTicks(24);
  for (std::size_t i = 10; i < ticks.size(); ++i) ticks[i] += 6'000;
  return ticks;
}

/// Frame i is grey with the value 20 + 8 i.
void DrawNumber(AVFrame* frame, int i) { tests::FillPlanes(frame, 20 + 8 * i, 128, 128); }

TEST(FilmTimes, APauseOfAVariableRateIsKept) {
  const tests::TemporaryFolder folder;
  for (const char* name : {"film.mov", "film.mp4", "film.mkv"}) {
    MadeFilm film;
    film.ticks = PausedTicks();
    tests::WriteFilm(folder / name, film, DrawNumber);
    const auto video = OpenVideo(folder / name, {});
    ASSERT_TRUE(video) << video.error().Message();
    EXPECT_EQ(video->frames->FrameCount(), 24);
    EXPECT_TRUE(video->frames->CountsExactly());
    EXPECT_NEAR(video->frame_rate_hz, 30000.0 / 1001.0, 0.2) << name;
    const auto frames = tests::ReadAll(*video->frames);
    ASSERT_EQ(frames.size(), film.ticks.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const double true_ns = static_cast<double>(film.ticks[i]) / 30'000.0 * 1e9;
      EXPECT_NEAR(static_cast<double>(frames[i].timestamp_ns), true_ns, 0.6e6) << name << i;
      EXPECT_EQ(frames[i].index, static_cast<std::int64_t>(i));
    }
  }
}

// An edit list that begins three frames late: what phones write when they trim a film.
TEST(FilmTimes, FramesThatAnEditListRemovesAreNotDelivered) {
  const tests::TemporaryFolder folder;
  MadeFilm film;
  film.ticks = tests::NtscTicks(16);
  film.muxer_options = {{"movie_timescale", "30000"}};
  tests::WriteFilm(folder / "film.mov", film, DrawNumber);
  std::string bytes = tests::Content(folder / "film.mov");
  const std::size_t list = bytes.find("elst");
  ASSERT_NE(list, std::string::npos);
  // After name, version and flags, number of entries, and duration: the start in the media.
  const std::size_t start = list + 4 + 4 + 4 + 4;
  std::uint32_t media_time = 0;
  for (int i = 0; i < 4; ++i)
    media_time = media_time << 8 | static_cast<std::uint8_t>(bytes[start + i]);
  media_time += 3 * 1001;
  for (int i = 0; i < 4; ++i) bytes[start + i] = static_cast<char>(media_time >> (24 - 8 * i));
  const auto video = OpenVideo(folder.Write("cut.mov", bytes), {});
  ASSERT_TRUE(video) << video.error().Message();
  const auto frames = tests::ReadAll(*video->frames);
  ASSERT_EQ(frames.size(), 13U);
  EXPECT_EQ(video->frames->FrameCount(), 13);
  EXPECT_EQ(frames[0].timestamp_ns, 0);
  EXPECT_EQ(frames[0].index, 0);
  // Video-range luma 20 + 8 * 3.
  EXPECT_NEAR(frames[0].rgb(10, 10, 1), (20 + 24 - 16) * 255.0 / 219.0, 2.0);
  EXPECT_NEAR(static_cast<double>(frames[12].timestamp_ns), 12 * 1001.0 / 30'000.0 * 1e9, 2.0);
}

TEST(FilmTimes, AnyFrameIsReachedAsIfAllBeforeItWereRead) {
  const tests::TemporaryFolder folder;
  for (const char* name : {"film.mov", "film.mkv", "film.avi"}) {
    MadeFilm film;
    film.ticks = PausedTicks();
    if (std::string(name) == "film.avi") {
      film.encoder = "mjpeg";
      film.pixels = "yuvj420p";
      film.full_range = true;
      film.ticks_per_s = 25;
      for (int i = 0; i < 24; ++i) film.ticks[i] = i;
    }
    tests::WriteFilm(folder / name, film, DrawNumber);
    auto all = OpenVideo(folder / name, {});
    ASSERT_TRUE(all) << all.error().Message();
    const auto frames = tests::ReadAll(*all->frames);
    ASSERT_EQ(frames.size(), 24U);
    for (const std::vector<std::size_t>& visits :
         {std::vector<std::size_t>{0, 7, 8, 20}, std::vector<std::size_t>{23},
          std::vector<std::size_t>{17, 18, 19}, std::vector<std::size_t>{1, 2, 15, 22}}) {
      const auto video = OpenVideo(folder / name, {});
      for (const std::size_t i : visits) {
        video->frames->SkipTo(static_cast<std::int64_t>(i));
        const auto frame = video->frames->Next();
        ASSERT_TRUE(frame && *frame) << name << i;
        EXPECT_EQ((*frame)->index, static_cast<std::int64_t>(i));
        EXPECT_EQ((*frame)->timestamp_ns, frames[i].timestamp_ns);
        EXPECT_EQ((*frame)->rgb(30, 20, 1), frames[i].rgb(30, 20, 1)) << name << i;
      }
    }
    const auto beyond = OpenVideo(folder / name, {});
    beyond->frames->SkipTo(24);
    const auto none = beyond->frames->Next();
    ASSERT_TRUE(none) << none.error().Message();
    EXPECT_FALSE(none->has_value());
  }
}

TEST(FilmTimes, ARecordingsRateReplacesThemOnlyWhereItDiffers) {
  const tests::TemporaryFolder folder;
  MadeFilm film;
  film.ticks = PausedTicks();
  tests::WriteFilm(folder / "film.mov", film, DrawNumber);
  VideoMetadata facts;
  facts.frame_rate_hz = 29.97;
  auto same = OpenVideo(folder / "film.mov", facts);
  ASSERT_TRUE(same);
  EXPECT_NEAR(static_cast<double>(tests::ReadAll(*same->frames)[23].timestamp_ns),
              (23 * 1001 + 6000) / 30'000.0 * 1e9, 2.0);
  facts.frame_rate_hz = 240.0;  // Slow motion.
  auto slow = OpenVideo(folder / "film.mov", facts);
  ASSERT_TRUE(slow);
  EXPECT_EQ(slow->frame_rate_hz, 240.0);
  EXPECT_EQ(tests::ReadAll(*slow->frames)[23].timestamp_ns, 95'833'333);
}

TEST(FilmTimes, StampsAreExactWhereTheirProductsExceed64Bits) {
  // 2^31 - 1 ticks per second, a year apart.
  const int unit = 2'147'483'647;
  const std::int64_t year_s = 31'536'000;
  const auto stamps = FilmStamps::Create({{year_s * unit, {}, true, false}, {0, {}, true, false}},
                                         {1, unit}, "film");
  ASSERT_TRUE(stamps);
  EXPECT_EQ(stamps->Nanoseconds(1), year_s * 1'000'000'000);
}

TEST(FilmTimes, HoursOfFilmAreIndexed) {
  // 100,000 frames in decoding order I P B B.
  std::vector<FilmPacket> packets;
  constexpr std::int64_t kOrder[] = {0, 3, 1, 2};
  for (std::int64_t i = 0; i < 100'000; ++i) {
    packets.push_back({(i / 4 * 4 + kOrder[i % 4]) * 1001, (i - 2) * 1001, i % 60 == 0, false});
  }
  const auto stamps = FilmStamps::Create(packets, {1, 30'000}, "film");
  ASSERT_TRUE(stamps);
  EXPECT_EQ(stamps->frames(), 100'000U);
  EXPECT_EQ(stamps->Nanoseconds(99'999), 3'336'633'300'000);
  EXPECT_EQ(stamps->EntryFor(99'999)->frame, 99'960U);
  EXPECT_NEAR(*stamps->TypicalRate_hz(), 29.97, 1e-3);
}

TEST(FilmTimes, ImpossibleStampsAreRefused) {
  const auto message = [](const std::vector<FilmPacket>& packets, FilmTimeBase unit) {
    const auto stamps = FilmStamps::Create(packets, unit, "film.mp4");
    return stamps ? std::string() : stamps.error().Message();
  };
  const FilmPacket zero{0, 0, true, false};
  EXPECT_THAT(message({}, {1, 25}), HasSubstr("no frames"));
  EXPECT_THAT(message({{0, 0, true, true}}, {1, 25}), HasSubstr("no frames"));
  EXPECT_THAT(message({zero, zero}, {1, 25}), HasSubstr("two frames at one time"));
  EXPECT_THAT(message({zero, {INT64_MAX, {}, false, false}}, {1, 25}), HasSubstr("span years"));
  EXPECT_THAT(message({{INT64_MIN + 1, {}, true, false}, {INT64_MAX, {}, false, false}}, {1, 25}),
              HasSubstr("span years"));
  EXPECT_THAT(message({zero}, {0, 25}), HasSubstr("no unit of time"));
  EXPECT_THAT(message({zero}, {1, -25}), HasSubstr("no unit of time"));
}

}  // namespace
}  // namespace pleinair::devices
