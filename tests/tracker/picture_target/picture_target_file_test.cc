// Tests target files: written content is read back, and invalid content is rejected.
#include "tracker/picture_target/target_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

namespace pleinair::tracker {
namespace {

using testing::HasSubstr;

/// A small artificial target with every element that a file can contain.
PictureTarget SmallTarget() {
  PictureTarget target;
  target.name = "poster – été";
  target.width_m = 0.42;
  target.height_m = 0.336;
  target.picture = GreyImage(40, 32);
  for (std::size_t i = 0; i < target.picture.size(); ++i) {
    target.picture.data()[i] = static_cast<std::uint8_t>(i * 37 % 251);
  }
  target.views = {{{5.0, 0.0, 19.5, 0.0, 4.0, 20.25}}, {{2.5, 0.1, 19.5, -0.1, 1.0, 7.0}}};
  for (int i = 0; i < 9; ++i) {
    const int view = i % 2;
    const auto& m = target.views[view].from_target;
    const double u = 6.0 * i + 3.0, v = 60.0 - 5.0 * i;
    target.keypoints.push_back({view, static_cast<float>(m[0] * u + m[1] * v + m[2]),
                                static_cast<float>(m[3] * u + m[4] * v + m[5]),
                                1.2F + 0.3F * static_cast<float>(i),
                                static_cast<float>(std::remainder(0.9 * i, 6.28))});
    QuantisedDescriptor descriptor;
    for (int k = 0; k < 64; ++k) descriptor.values[k] = static_cast<std::int8_t>(i * 29 + k * 3);
    for (std::int8_t& value : descriptor.values) value = std::max<std::int8_t>(value, -127);
    descriptor.bright = i % 3 == 0;
    target.descriptors.push_back(descriptor);
  }
  return target;
}

constexpr std::size_t kHeader = 20, kChecksum = 16, kLength = 12, kVersion = 8;

template <typename T>
void Set(std::string* bytes, std::size_t at, T value) {
  ASSERT_LE(at + sizeof(T), bytes->size());
  std::memcpy(bytes->data() + at, &value, sizeof(T));
}

/// Updates length and checksum after a change of the content.
std::string Sealed(std::string bytes) {
  Set(&bytes, kLength, static_cast<std::uint32_t>(bytes.size() - kHeader));
  Set(&bytes, kChecksum, Crc32(std::string_view(bytes).substr(kHeader)));
  return bytes;
}

TEST(TargetFile, GivesBackWhatWasWritten) {
  const PictureTarget target = SmallTarget();
  const std::string bytes = SerializeTarget(target);
  const auto read = ParseTarget(bytes, "poster.target");
  ASSERT_TRUE(read.has_value()) << read.error().Message();
  EXPECT_EQ(read->name, target.name);
  EXPECT_EQ(read->width_m, target.width_m);
  EXPECT_EQ(read->height_m, target.height_m);
  ASSERT_EQ(read->picture.width(), 40);
  ASSERT_EQ(read->picture.height(), 32);
  EXPECT_EQ(std::memcmp(read->picture.data(), target.picture.data(), target.picture.size()), 0);
  ASSERT_EQ(read->views.size(), 2U);
  EXPECT_EQ(read->views[1].from_target, target.views[1].from_target);
  ASSERT_EQ(read->keypoints.size(), 9U);
  ASSERT_EQ(read->descriptors.size(), 9U);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(read->keypoints[i].view, target.keypoints[i].view);
    EXPECT_EQ(read->keypoints[i].x, target.keypoints[i].x);
    EXPECT_EQ(read->keypoints[i].y, target.keypoints[i].y);
    EXPECT_EQ(read->keypoints[i].scale, target.keypoints[i].scale);
    EXPECT_EQ(read->keypoints[i].angle_rad, target.keypoints[i].angle_rad);
    EXPECT_EQ(read->descriptors[i].values, target.descriptors[i].values);
    EXPECT_EQ(read->descriptors[i].bright, target.descriptors[i].bright);
  }
  EXPECT_EQ(SerializeTarget(*read), bytes);
}

TEST(TargetFile, IsLaidOutAsDocumented) {
  const std::string bytes = SerializeTarget(SmallTarget());
  EXPECT_EQ(bytes.substr(0, 8), "PLEINTGT");
  EXPECT_EQ(bytes.substr(kVersion, 4), std::string("\1\0\0\0", 4));
  // Name, two doubles, two sides, pixels, two views, nine keypoints, with their counts.
  EXPECT_EQ(bytes.size(), kHeader + 2 + 16 + 16 + 4 + 40 * 32 + 2 + 2 * 48 + 4 + 9 * 82);
  EXPECT_EQ(static_cast<unsigned char>(bytes[kHeader]), SmallTarget().name.size());
}

TEST(TargetFile, ChecksumIsThatOfZlib) {
  // The check value in catalogues of CRCs for CRC-32/ISO-HDLC.
  EXPECT_EQ(Crc32("123456789"), 0xCBF43926U);
  EXPECT_EQ(Crc32(""), 0U);
}

TEST(TargetFile, IsRefusedWhereverItIsCut) {
  const std::string bytes = SerializeTarget(SmallTarget());
  for (std::size_t length = 0; length < bytes.size(); length += length < 60 ? 1 : 13) {
    const auto read = ParseTarget(std::string_view(bytes).substr(0, length), "cut.target");
    ASSERT_FALSE(read.has_value()) << length;
    EXPECT_EQ(read.error().kind, ErrorKind::kInput);
    EXPECT_EQ(read.error().where, "cut.target");
    EXPECT_FALSE(read.error().remedy.empty());
    // Truncated with valid length and checksum: the counts do not match.
    if (length > kHeader) {
      const auto sealed = ParseTarget(Sealed(bytes.substr(0, length)), "cut.target");
      EXPECT_FALSE(sealed.has_value()) << length;
    }
  }
  EXPECT_FALSE(ParseTarget(bytes + "x", "long").has_value());
  EXPECT_FALSE(ParseTarget(Sealed(bytes + "x"), "long").has_value());
}

TEST(TargetFile, IsRefusedWhereAnyByteIsDamaged) {
  const std::string bytes = SerializeTarget(SmallTarget());
  for (std::size_t at = 0; at < bytes.size(); at += at < 40 ? 1 : 7) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_FALSE(ParseTarget(damaged, "damaged").has_value()) << "byte " << at;
  }
}

TEST(TargetFile, OfALaterVersionSaysSo) {
  std::string bytes = SerializeTarget(SmallTarget());
  Set(&bytes, kVersion, std::uint32_t{2});
  const auto read = ParseTarget(bytes, "new.target");
  ASSERT_FALSE(read.has_value());
  EXPECT_THAT(read.error().Message(), HasSubstr("new.target: is a target file of version 2"));
}

/// Malicious content with valid length and checksum.
struct Hostile {
  const char* name;
  std::function<void(PictureTarget*)> change;
};

void PrintTo(const Hostile& hostile, std::ostream* out) { *out << hostile.name; }

class HostileTarget : public testing::TestWithParam<Hostile> {};

TEST_P(HostileTarget, IsRefusedByName) {
  PictureTarget target = SmallTarget();
  GetParam().change(&target);
  const auto read = ParseTarget(SerializeTarget(target), "hostile.target");
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().where, "hostile.target");
  EXPECT_THAT(read.error().Message(), HasSubstr("make it again"));
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr float kNanF = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfF = std::numeric_limits<float>::infinity();

std::vector<Hostile> EveryHostile() {
  return {
      Hostile{"NoName", [](PictureTarget* t) { t->name.clear(); }},
      Hostile{"NameOfControlCharacters", [](PictureTarget* t) { t->name = "a\x1b[2Jb"; }},
      Hostile{"NameThatIsNoUtf8", [](PictureTarget* t) { t->name = "\xff\xfe"; }},
      Hostile{"NameCutInACharacter", [](PictureTarget* t) { t->name = "caf\xc3"; }},
      Hostile{"NameTooLong", [](PictureTarget* t) { t->name.assign(201, 'a'); }},
      Hostile{"WidthNotANumber", [](PictureTarget* t) { t->width_m = kNan; }},
      Hostile{"WidthOfZero", [](PictureTarget* t) { t->width_m = 0.0; }},
      Hostile{"WidthNegative", [](PictureTarget* t) { t->width_m = -0.4; }},
      Hostile{"HeightInfinite", [](PictureTarget* t) { t->height_m = kInfF; }},
      Hostile{"HeightOfAThread", [](PictureTarget* t) { t->height_m = 0.002; }},
      Hostile{"PictureEmpty", [](PictureTarget* t) { t->picture = GreyImage(); }},
      Hostile{"PictureTooSmall", [](PictureTarget* t) { t->picture = GreyImage(31, 40); }},
      Hostile{"PictureTooLarge", [](PictureTarget* t) { t->picture = GreyImage(513, 40); }},
      Hostile{"NoViews",
              [](PictureTarget* t) {
                t->views.clear();
                t->keypoints.clear();
                t->descriptors.clear();
              }},
      Hostile{"ViewNotANumber", [](PictureTarget* t) { t->views[1].from_target[3] = kNan; }},
      Hostile{"ViewFlat", [](PictureTarget* t) { t->views[1].from_target = {1, 1, 0, 1, 1, 0}; }},
      Hostile{"ViewMirrored",
              [](PictureTarget* t) { t->views[1].from_target = {-1, 0, 64, 0, 1, 0}; }},
      Hostile{"ViewHuge", [](PictureTarget* t) { t->views[0].from_target[2] = 1e300; }},
      Hostile{"NoFeatures",
              [](PictureTarget* t) {
                t->keypoints.clear();
                t->descriptors.clear();
              }},
      Hostile{"FeatureOfAViewThatIsNotThere", [](PictureTarget* t) { t->keypoints[4].view = 2; }},
      Hostile{"FeatureNowhere", [](PictureTarget* t) { t->keypoints[4].x = kNanF; }},
      Hostile{"FeatureOffThePicture", [](PictureTarget* t) { t->keypoints[4].y = 4000.0F; }},
      Hostile{"FeatureWithoutScale", [](PictureTarget* t) { t->keypoints[4].scale = 0.0F; }},
      Hostile{"FeatureOfInfiniteScale", [](PictureTarget* t) { t->keypoints[4].scale = kInfF; }},
      Hostile{"FeatureTurnedForEver", [](PictureTarget* t) { t->keypoints[4].angle_rad = 1e9F; }},
      Hostile{"DescriptorOutOfRange",
              [](PictureTarget* t) { t->descriptors[4].values[7] = -128; }}};
}

INSTANTIATE_TEST_SUITE_P(TargetFile, HostileTarget, testing::ValuesIn(EveryHostile()),
                         [](const auto& param_info) { return param_info.param.name; });

TEST(TargetFile, TellingOfMoreThanItHoldsIsRefused) {
  const PictureTarget target = SmallTarget();
  const std::string bytes = SerializeTarget(target);
  const std::size_t views_at = kHeader + 2 + target.name.size() + 16 + 4 + target.picture.size();
  const std::size_t keypoints_at = views_at + 2 + 2 * 48;
  for (const std::uint32_t count : {0U, 8U, 10U, 8193U, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
    std::string changed = bytes;
    Set(&changed, keypoints_at, count);
    EXPECT_FALSE(ParseTarget(Sealed(changed), "x").has_value()) << count;
  }
  for (const int count : {0, 1, 3, 129, 65535}) {
    std::string changed = bytes;
    Set(&changed, views_at, static_cast<std::uint16_t>(count));
    EXPECT_FALSE(ParseTarget(Sealed(changed), "x").has_value()) << count;
  }
  std::string changed = bytes;
  Set(&changed, kHeader, std::uint16_t{65535});
  EXPECT_FALSE(ParseTarget(Sealed(changed), "x").has_value());
}

TEST(TargetFile, OnDiskIsWrittenWholeAndReadBack) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::path(testing::TempDir()) / ("target_file_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const PictureTarget target = SmallTarget();
  ASSERT_TRUE(WriteTargetFile(target, folder / "a.target").has_value());
  const auto read = ReadTargetFile(folder / "a.target");
  ASSERT_TRUE(read.has_value()) << read.error().Message();
  EXPECT_EQ(SerializeTarget(*read), SerializeTarget(target));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);

  EXPECT_FALSE(WriteTargetFile(target, folder / "none" / "a.target").has_value());
  for (const fs::path& bad : {folder / "none.target", folder}) {
    const auto refused = ReadTargetFile(bad);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
    EXPECT_EQ(refused.error().where, bad.string());
  }
  std::ofstream(folder / "huge.target") << "PLEINTGT";
  fs::resize_file(folder / "huge.target", 50'000'000);
  const auto huge = ReadTargetFile(folder / "huge.target");
  ASSERT_FALSE(huge.has_value());
  EXPECT_THAT(huge.error().Message(), HasSubstr("too large"));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace pleinair::tracker
