#include "devices/recordings/frame_pack.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "devices/recordings/recording.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using testing::HasSubstr;

constexpr ImageSize kSize{8, 4};
constexpr std::int64_t kStart_ns = 5'000'000'000;

Frame MakeFrame(int number) {
  RawImage raw;
  raw.format = PixelFormat::kYuyv;
  raw.width = kSize.width;
  raw.height = kSize.height;
  raw.stride = 16;
  raw.matrix = YuvMatrix::kBt709;
  std::mt19937 random(static_cast<unsigned>(number));
  raw.bytes.resize(64);
  for (std::uint8_t& byte : raw.bytes) byte = static_cast<std::uint8_t>(random());
  Frame frame;
  frame.index = number;
  frame.timestamp_ns = kStart_ns + number * 40'000'000LL;
  frame.stamp_meaning = StampMeaning::kExposureStart;
  frame.arrival_ns = frame.timestamp_ns + 7'000'000;
  frame.device_timestamp_ns = 99 + number;
  frame.settings.exposure_s = 0.01 + 0.001 * number;
  frame.settings.gain = 2.5;
  frame.loss = {.by_number = number % 3, .not_taken = 1};
  frame.lost_before = frame.loss.Total();
  DecodedImage image;
  EXPECT_TRUE(ConvertRawImage(raw, &image));
  frame.rgb = image.rgb;
  frame.grey = image.grey;
  frame.raw = std::make_shared<const RawImage>(std::move(raw));
  return frame;
}

std::filesystem::path Record(const tests::TemporaryFolder& folder, int frames) {
  const std::filesystem::path file = folder / "frames.pack";
  const auto writer = FramePackWriter::Create(file);
  EXPECT_TRUE(writer);
  for (int i = 0; i < frames; ++i) EXPECT_TRUE((*writer)->Add(MakeFrame(i)));
  EXPECT_EQ((*writer)->bytes(), static_cast<std::int64_t>(std::filesystem::file_size(file)));
  return file;
}

std::string Bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void ExpectSame(const Frame& read, int number) {
  const Frame written = MakeFrame(number);
  EXPECT_EQ(read.index, number);
  EXPECT_EQ(read.timestamp_ns, written.timestamp_ns - kStart_ns);
  EXPECT_EQ(read.arrival_ns, *written.arrival_ns - kStart_ns);
  EXPECT_EQ(read.stamp_meaning, written.stamp_meaning);
  EXPECT_EQ(read.device_timestamp_ns, written.device_timestamp_ns);
  EXPECT_EQ(read.settings.exposure_s, written.settings.exposure_s);
  EXPECT_EQ(read.settings.gain, written.settings.gain);
  EXPECT_EQ(read.settings.white_balance_k, std::nullopt);
  EXPECT_EQ(read.loss, written.loss);
  ASSERT_EQ(read.grey.size(), written.grey.size());
  EXPECT_TRUE(
      std::equal(read.grey.data(), read.grey.data() + read.grey.size(), written.grey.data()));
  EXPECT_TRUE(std::equal(read.rgb.data(), read.rgb.data() + read.rgb.size(), written.rgb.data()));
}

TEST(FramePack, GivesBackEveryFrameAsItWas) {
  const tests::TemporaryFolder folder;
  const auto opened = OpenFramePack(Record(folder, 5), kSize);
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->dropped_bytes, 0);
  EXPECT_NEAR(opened->frame_rate_hz, 25.0, 1e-9);
  ASSERT_EQ(opened->frames->FrameCount(), 5);
  for (int i = 0; i < 5; ++i) {
    const auto frame = opened->frames->Next();
    ASSERT_TRUE(frame && *frame);
    ExpectSame(**frame, i);
  }
  EXPECT_FALSE(*opened->frames->Next());
}

TEST(FramePack, CutAtAnyByteOpensUpToItsLastWholeFrame) {
  const tests::TemporaryFolder folder;
  const std::string whole = Bytes(Record(folder, 3));
  std::vector<std::size_t> ends;
  for (int frames = 1; frames <= 3; ++frames) {
    const tests::TemporaryFolder part;
    ends.push_back(Bytes(Record(part, frames)).size());
  }
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    const auto file = folder.Write("cut.pack", whole.substr(0, length));
    const auto opened = OpenFramePack(file, kSize);
    const auto expected = static_cast<std::int64_t>(
        std::count_if(ends.begin(), ends.end(), [&](std::size_t end) { return end <= length; }));
    ASSERT_EQ(opened.has_value(), expected > 0) << "cut at " << length;
    if (!opened) continue;
    ASSERT_EQ(opened->frames->FrameCount(), expected) << "cut at " << length;
    ASSERT_EQ(opened->dropped_bytes,
              static_cast<std::int64_t>(length - ends[static_cast<std::size_t>(expected - 1)]));
    for (int i = 0; i < expected; ++i) {
      const auto frame = opened->frames->Next();
      ASSERT_TRUE(frame && *frame);
      ExpectSame(**frame, i);
    }
  }
}

TEST(FramePack, WhoseLastBytesNeverReachedTheDiskOpensUpToTheLastWholeFrame) {
  const tests::TemporaryFolder folder;
  const std::string whole = Bytes(Record(folder, 3));
  const std::size_t two = [] {
    const tests::TemporaryFolder part;
    return Bytes(Record(part, 2)).size();
  }();
  for (std::size_t lost = 1; lost < whole.size() - two; lost += 5) {
    std::string zeroed = whole;
    std::fill(zeroed.end() - static_cast<long>(lost), zeroed.end(), '\0');
    const auto opened = OpenFramePack(folder.Write("zeroed.pack", zeroed), kSize);
    ASSERT_TRUE(opened);
    ASSERT_EQ(opened->frames->FrameCount(), 2) << lost << " bytes are zero";
  }
}

/// The numbers of the frames that a damaged pack still gives, each checked against the original.
/// Empty where it holds no whole frame.
std::vector<int> FramesLeftIn(const std::filesystem::path& file, bool* says_loss) {
  const auto opened = OpenFramePack(file, kSize);
  if (!opened) {
    EXPECT_THAT(opened.error().what, HasSubstr("holds no whole frame"));
    *says_loss = true;
    return {};
  }
  EXPECT_EQ(opened->damage->empty(), opened->dropped_bytes == 0);
  std::vector<int> left;
  std::int64_t first = -1;
  while (true) {
    const auto frame = opened->frames->Next();
    EXPECT_TRUE(frame);
    *says_loss = !opened->damage->empty();
    if (!frame || !*frame) return left;
    const auto number = static_cast<int>(*(*frame)->device_timestamp_ns - 99);
    if (first < 0) first = number;
    EXPECT_EQ((*frame)->index, static_cast<std::int64_t>(left.size()));
    EXPECT_EQ((*frame)->timestamp_ns, (number - first) * 40'000'000LL);
    const Frame whole = MakeFrame(number);
    EXPECT_TRUE(
        std::equal(whole.rgb.data(), whole.rgb.data() + whole.rgb.size(), (*frame)->rgb.data()));
    left.push_back(number);
  }
}

std::vector<std::size_t> FrameEnds(int frames) {
  std::vector<std::size_t> ends;
  for (int i = 0; i <= frames; ++i) {
    const tests::TemporaryFolder part;
    ends.push_back(Bytes(Record(part, i)).size());
  }
  return ends;
}

TEST(FramePack, LosesOneFrameByAFlippedBitAndSaysSo) {
  constexpr int kFrames = 5;
  const tests::TemporaryFolder folder;
  const std::string whole = Bytes(Record(folder, kFrames));
  const std::vector<std::size_t> ends = FrameEnds(kFrames);
  for (std::size_t at = 16; at < whole.size(); at += at < ends[1] + 24 ? 1 : 11) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << at % 8));
    bool says_loss = false;
    const std::vector<int> left = FramesLeftIn(folder.Write("flipped.pack", bytes), &says_loss);
    const auto hit =
        static_cast<int>(std::upper_bound(ends.begin(), ends.end(), at) - ends.begin()) - 1;
    std::vector<int> expected = {0, 1, 2, 3, 4};
    // Four bytes of each header are unused.
    const std::size_t in_frame = at - ends[static_cast<std::size_t>(hit)];
    const bool unused = in_frame >= 20 && in_frame < 24;
    if (!unused) expected.erase(expected.begin() + hit);
    ASSERT_EQ(left, expected) << "byte " << at;
    ASSERT_EQ(says_loss, !unused) << "byte " << at;
  }
}

TEST(FramePack, LosesOnlyTheFramesThatAMissingPieceTouches) {
  constexpr int kFrames = 5;
  const tests::TemporaryFolder folder;
  const std::string whole = Bytes(Record(folder, kFrames));
  const std::vector<std::size_t> ends = FrameEnds(kFrames);
  for (const std::size_t length : {1, 100, 400, 900}) {
    for (std::size_t at = 16; at + length < whole.size(); at += 37) {
      std::string bytes = whole;
      bytes.erase(at, length);
      bool says_loss = false;
      const std::vector<int> left = FramesLeftIn(folder.Write("cut.pack", bytes), &says_loss);
      std::vector<int> expected;
      for (std::size_t i = 0; i < kFrames; ++i) {
        if (ends[i + 1] <= at || ends[i] >= at + length) expected.push_back(static_cast<int>(i));
      }
      ASSERT_EQ(left, expected) << length << " bytes at " << at;
      const bool whole_frames_only = std::count(ends.begin(), ends.end(), at) > 0 &&
                                     std::count(ends.begin(), ends.end(), at + length) > 0;
      ASSERT_EQ(says_loss, !whole_frames_only) << length << " bytes at " << at;
    }
  }
}

/// Opening several GB must not take the time to read them. Pixels that it does not read cannot show
/// it their damage.
TEST(FramePack, ReadsAtOpeningNoPixelsBetweenTheFirstFrameAndTheLast) {
  constexpr int kFrames = 6;
  const tests::TemporaryFolder folder;
  std::string bytes = Bytes(Record(folder, kFrames));
  const std::vector<std::size_t> ends = FrameEnds(kFrames);
  for (const std::size_t frame : {1, 2, 4}) bytes[ends[frame + 1] - 9] ^= 1;
  const auto opened = OpenFramePack(folder.Write("damaged.pack", bytes), kSize);
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->frames->FrameCount(), kFrames);
  EXPECT_NEAR(opened->frame_rate_hz, 25.0, 1e-9);
  EXPECT_TRUE(opened->damage->empty());
  const auto next = [&] {
    const auto frame = opened->frames->Next();
    EXPECT_TRUE(frame);
    return frame && *frame ? *(*frame)->device_timestamp_ns - 99 : -1;
  };
  EXPECT_EQ(next(), 0);
  EXPECT_TRUE(opened->damage->empty());
  // The damage is told with the frame behind it, all at once.
  EXPECT_EQ(next(), 3);
  ASSERT_EQ(opened->damage->size(), 2);
  EXPECT_THAT(opened->damage->at(0),
              HasSubstr(std::to_string(ends[3] - ends[1]) +
                        " bytes before frame 1 are damaged: no whole frame between 0.00 s and "
                        "0.12 s"));
  EXPECT_THAT(opened->damage->at(1), HasSubstr("before frame 2 are damaged"));
  EXPECT_EQ(next(), 5);
  EXPECT_EQ(next(), -1);
}

TEST(FramePack, WithADamagedBeginningIsStillAPack) {
  const tests::TemporaryFolder folder;
  std::string bytes = Bytes(Record(folder, 3));
  bytes[3] = 'X';
  bool says_loss = false;
  EXPECT_EQ(FramesLeftIn(folder.Write("damaged.pack", bytes), &says_loss),
            (std::vector<int>{0, 1, 2}));
}

TEST(FramePack, NamesTheDamageAndRecoversTheWholeFrames) {
  const tests::TemporaryFolder folder;
  std::string bytes = Bytes(Record(folder, 4));
  const std::vector<std::size_t> ends = FrameEnds(4);
  bytes[ends[1] + 6] = static_cast<char>(bytes[ends[1] + 6] ^ 1);
  const auto damaged = folder.Write("damaged.pack", bytes);
  const auto opened = OpenFramePack(damaged, kSize);
  ASSERT_TRUE(opened);
  ASSERT_EQ(opened->damage->size(), 1);
  EXPECT_THAT(opened->damage->front(),
              HasSubstr("before frame 1 are damaged: no whole frame between "
                        "0.00 s and 0.08 s"));
  const auto go_on = [] { return Result<void>(); };
  const auto recovered = RecoverFramePack(damaged, folder / "clean.pack", go_on);
  ASSERT_TRUE(recovered);
  EXPECT_EQ(recovered->frames, 3);
  EXPECT_EQ(recovered->damage, *opened->damage);
  std::string kept = bytes;
  kept.erase(ends[1], ends[2] - ends[1]);
  EXPECT_EQ(Bytes(folder / "clean.pack"), kept);
}

TEST(FramePack, OnAFullDiskEndsWithTheFrameBeforeAndSaysSo) {
  const tests::TemporaryFolder folder;
  const auto writer = FramePackWriter::Create(folder / "frames.pack");
  ASSERT_TRUE(writer);
  ASSERT_TRUE((*writer)->Add(MakeFrame(0)));
  // Like a full disk, a limit on the file size permits a partial write.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{static_cast<rlim_t>((*writer)->bytes() + 100), before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const auto full = (*writer)->Add(MakeFrame(1));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(full);
  EXPECT_THAT(full.error().Message(), HasSubstr("free some space"));
  EXPECT_FALSE((*writer)->Add(MakeFrame(2)));
  const auto opened = OpenFramePack(folder / "frames.pack", kSize);
  ASSERT_TRUE(opened);
  EXPECT_EQ(opened->frames->FrameCount(), 1);
  EXPECT_EQ(opened->dropped_bytes, 0);
}

TEST(FramePack, NeverReplacesOneThatIsThere) {
  const tests::TemporaryFolder folder;
  const auto file = Record(folder, 1);
  const auto again = FramePackWriter::Create(file);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().what, HasSubstr("already"));
}

TEST(FramePack, OpensAsARecordingByItsContent) {
  const tests::TemporaryFolder folder;
  Record(folder, 4);
  folder.Write("recording.json",
               R"({"frames":"frames.pack","calibration":{"image_width":8,"image_height":4,)"
               R"("fx":8,"fy":8,"cx":3.5,"cy":1.5}})");
  const auto recording = OpenRecording(folder.path());
  ASSERT_TRUE(recording) << recording.error().Message();
  EXPECT_EQ(recording->frames->FrameCount(), 4);
  EXPECT_NEAR(recording->frame_rate_hz, 25.0, 1e-9);
}

}  // namespace
}  // namespace pleinair::devices
