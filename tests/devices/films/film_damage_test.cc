#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "devices/recordings/video_file.h"
#include "tests/devices/films/made_film.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using tests::MadeFilm;

// A texture, so that packets have some length.
void DrawTexture(AVFrame* frame, int i) {
  tests::FillPlanes(frame, 128, 128, 128);
  for (int k = 0; k < frame->linesize[0] * frame->height; ++k) {
    frame->data[0][k] = static_cast<std::uint8_t>(40 + (k * 37 + i * 11) % 160);
  }
}

/// What reading to the end says; empty: nothing is wrong.
std::string Complaint(const std::filesystem::path& file) {
  const auto video = OpenVideo(file, {});
  if (!video) return video.error().Message();
  for (;;) {
    const auto frame = video->frames->Next();
    if (!frame) return frame.error().Message();
    if (!*frame) return "";
  }
}

TEST(FilmDamage, AFilmCutAtAnyHundredthByteIsRefused) {
  const tests::TemporaryFolder folder;
  for (const char* name : {"film.mov", "film.mkv", "start.mp4"}) {
    MadeFilm film;
    film.ticks = tests::NtscTicks(10);
    if (std::string(name) == "start.mp4") film.muxer_options = {{"movflags", "+faststart"}};
    tests::WriteFilm(folder / name, film, DrawTexture);
    EXPECT_EQ(Complaint(folder / name), "");
    const std::string whole = tests::Content(folder / name);
    ASSERT_GT(whole.size(), 10'000U);
    for (std::size_t length = 100; length < whole.size(); length += 100) {
      const auto part = folder.Write(std::string("part_") + name, whole.substr(0, length));
      const auto video = OpenVideo(part, {});
      ASSERT_FALSE(video) << name << " of " << length << " of " << whole.size() << " bytes";
      EXPECT_THAT(video.error().Message(), AnyOf(HasSubstr("cut short"), HasSubstr("damaged")));
    }
  }
}

TEST(FilmDamage, OverwrittenImagesAreRefusedByTheFrame) {
  const tests::TemporaryFolder folder;
  MadeFilm film;
  film.ticks = tests::NtscTicks(24);
  tests::WriteFilm(folder / "film.mov", film, DrawTexture);
  std::string bytes = tests::Content(folder / "film.mov");
  const std::size_t data = bytes.find("mdat");
  // In the middle of the images, over a length of a few frames.
  const std::size_t middle = data + (bytes.find("moov") - data) / 2;
  for (std::size_t i = middle; i < middle + 3'000; ++i) bytes[i] = static_cast<char>(i * 7);
  EXPECT_THAT(Complaint(folder.Write("bad.mov", bytes)), HasSubstr("bad.mov: is damaged"));
}

/// Adds `change` to the big-endian number of four bytes at an offset from a box's type.
std::string WithChangedCount(std::string bytes, const std::string& type, std::size_t offset,
                             int change) {
  const std::size_t at = bytes.find(type) + type.size() + offset;
  bytes.at(at + 3) = static_cast<char>(bytes.at(at + 3) + change);
  return bytes;
}

TEST(FilmDamage, TablesThatDisagreeOnTheNumberOfFramesAreRefused) {
  const tests::TemporaryFolder folder;
  MadeFilm film;
  film.ticks = tests::NtscTicks(9);
  tests::WriteFilm(folder / "film.mov", film, DrawTexture);
  const std::string whole = tests::Content(folder / "film.mov");
  struct {
    const char* table;
    std::size_t offset;
  } constexpr kCounts[] = {{"stsz", 8}, {"stts", 8}};
  for (const auto& [table, offset] : kCounts) {
    for (const int change : {-6, -1}) {
      SCOPED_TRACE(testing::Message() << table << " " << change);
      const auto file = folder.Write("bad.mov", WithChangedCount(whole, table, offset, change));
      const std::string frames = std::to_string(9 + change);
      EXPECT_THAT(Complaint(file), HasSubstr("bad.mov: is damaged: its header announces 9 frames "
                                             "in one table and " +
                                             frames + " in another"));
    }
  }
}

TEST(FilmDamage, OtherFilesAreNoFilms) {
  const tests::TemporaryFolder folder;
  // A playlist would make libavformat open the files that it names.
  MadeFilm film;
  film.ticks = tests::NtscTicks(3);
  tests::WriteFilm(folder / "film.ts", film, DrawTexture);
  EXPECT_EQ(Complaint(folder / "film.ts"), "");
  folder.Write("list.m3u8",
               "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\nfilm.ts\n#EXT-X-ENDLIST\n");
  folder.Write("list.ffconcat", "ffconcat version 1.0\nfile film.ts\n");
  for (const char* name : {"list.m3u8", "list.ffconcat"}) {
    EXPECT_THAT(Complaint(folder / name), HasSubstr("no known format"));
  }
  EXPECT_THAT(Complaint("/dev/null"), HasSubstr("/dev/null"));
}

}  // namespace
}  // namespace pleinair::devices
