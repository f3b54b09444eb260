#include "export/trajectories/record3d_archive.h"

#include <gmock/gmock.h>

#include <cstddef>
#include <string>

#include "export/trajectories/record3d_trajectory.h"
#include "export/trajectories/trajectory_files.h"
#include "files/text_file.h"
#include "tests/error_message.h"
#include "tests/source_tree.h"

namespace pleinair::exports {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tests::MessageOf;

/// An archive of two files, the second of which is the metadata.
std::filesystem::path ArchiveFile(const char* name) {
  return tests::SourceTree() / "tests/fuzz/corpus/path" / name;
}

std::string ArchiveBytes(const char* name) {
  return files::ReadWholeFile(ArchiveFile(name), std::size_t{1} << 20).value();
}

/// Where the last entry of the central directory begins (APPNOTE.TXT 6.3.10, 4.3.12).
std::size_t LastEntry(const std::string& bytes) { return bytes.rfind(std::string("PK\1\2", 4)); }

/// The archive with another uncompressed size of its metadata in the central directory.
std::string WithSize(std::string bytes, std::size_t size) {
  constexpr std::size_t kSizeOffset = 24;
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[LastEntry(bytes) + kSizeOffset + i] = static_cast<char>(size >> (8 * i));
  }
  return bytes;
}

TEST(Record3dArchive, IsReadAsItIsShared) {
  for (const char* name : {"stored.r3d", "deflated.r3d"}) {
    const std::filesystem::path file = ArchiveFile(name);
    EXPECT_TRUE(IsZipArchive(file));
    ASSERT_EQ(TrajectoryFormatOf(file), TrajectoryFormat::kRecord3d);
    const auto path = ReadTrajectory(file, TrajectoryFormat::kRecord3d, {});
    ASSERT_TRUE(path) << path.error().Message();
    ASSERT_EQ(path->poses.size(), 2U);
    EXPECT_EQ(path->poses[1].timestamp_ns, 16'700'000);
    ASSERT_TRUE(path->camera);
    EXPECT_EQ(path->camera->width, 720);
  }
  EXPECT_THAT(MessageOf(ReadTrajectory("none.r3d", TrajectoryFormat::kRecord3d, {})),
              StartsWith("none.r3d: there is no such file"));
}

TEST(Record3dArchive, CutAndDamagedOnesAreRefused) {
  for (const char* name : {"stored.r3d", "deflated.r3d"}) {
    const std::string whole = ArchiveBytes(name);
    for (std::size_t length = 1; length < whole.size(); ++length) {
      EXPECT_THAT(MessageOf(ParseRecord3dArchive(whole.substr(0, length), "walk.r3d")),
                  HasSubstr("is no whole zip archive"))
          << length;
    }
    // A changed byte is an error, or does not change the metadata.
    const std::string json = ParseRecord3dArchive(whole, "walk.r3d").value();
    for (std::size_t at = 0; at < whole.size(); ++at) {
      std::string changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ 0x15);
      const auto read = ParseRecord3dArchive(changed, "walk.r3d");
      EXPECT_EQ(read.value_or(json), json) << at;
    }
  }
}

TEST(Record3dArchive, BombsAreRefusedBeforeTheyUnpack) {
  const std::string whole = ArchiveBytes("deflated.r3d");
  for (const std::size_t size :
       {std::size_t{2} << 20, std::size_t{200} << 20, std::size_t{0xFFFFFFFE}}) {
    EXPECT_THAT(MessageOf(ParseRecord3dArchive(WithSize(whole, size), "walk.r3d")),
                HasSubstr("would unpack to more"));
  }
  // An entry that holds more or less than it states.
  for (const std::size_t size : {3, 100'000}) {
    EXPECT_THAT(MessageOf(ParseRecord3dArchive(WithSize(whole, size), "walk.r3d")),
                HasSubstr("is no whole zip archive"));
  }
}

TEST(Record3dArchive, EncryptedOnesAreRefused) {
  // Bit 0 of the general purpose flag in both headers of the metadata (APPNOTE.TXT 6.3.10, 4.4.4).
  std::string bytes = ArchiveBytes("deflated.r3d");
  constexpr std::size_t kFlagInEntry = 8, kFlagInHeader = 6;
  bytes[LastEntry(bytes) + kFlagInEntry] |= 1;
  bytes[bytes.rfind(std::string("PK\3\4", 4)) + kFlagInHeader] |= 1;
  EXPECT_THAT(MessageOf(ParseRecord3dArchive(bytes, "walk.r3d")),
              StartsWith("walk.r3d: is encrypted"));
}

TEST(Record3dArchive, OtherNamesAreNoMetadata) {
  // Names that lead out of the archive's folder, or are longer, are never opened.
  for (const char* name : {"../etada", "METADATA", "/etc/pwd", "metadat\\"}) {
    std::string bytes = ArchiveBytes("stored.r3d");
    for (std::size_t at = bytes.find("metadata"); at != std::string::npos;
         at = bytes.find("metadata")) {
      bytes.replace(at, 8, name);
    }
    EXPECT_THAT(MessageOf(ParseRecord3dArchive(bytes, "walk.r3d")),
                AllOf(StartsWith("walk.r3d: "), HasSubstr("without metadata")))
        << name;
  }
}

}  // namespace
}  // namespace pleinair::exports
