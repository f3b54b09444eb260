#include "base/atomic_file.h"

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace pleinair {
namespace {

using ::testing::HasSubstr;

class AtomicFile : public ::testing::Test {
 protected:
  AtomicFile()
      : folder_(std::filesystem::path(::testing::TempDir()) /
                ("pleinair_atomic_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~AtomicFile() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::size_t FilesInFolder() const {
    const std::filesystem::directory_iterator entries(folder_);
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
  }

  static std::string Content(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  const std::filesystem::path folder_;
};

TEST_F(AtomicFile, WritesAllBytesAndLeavesNothingElse) {
  const std::string content("a\0b\n", 4);
  ASSERT_TRUE(WriteFileAtomically(folder_ / "out.json", content));
  EXPECT_EQ(Content(folder_ / "out.json"), content);
  EXPECT_EQ(FilesInFolder(), 1U);
}

TEST_F(AtomicFile, ReplacesAnOlderFile) {
  ASSERT_TRUE(WriteFileAtomically(folder_ / "out.json", "old and longer"));
  ASSERT_TRUE(WriteFileAtomically(folder_ / "out.json", "new"));
  EXPECT_EQ(Content(folder_ / "out.json"), "new");
}

TEST_F(AtomicFile, WritesTheFileThatALinkNamesAndKeepsTheLink) {
  std::filesystem::create_directory(folder_ / "far");
  std::filesystem::create_symlink("far/target.json", folder_ / "link.json");
  for (const char* content : {"through a link to nothing yet", "and to a file"}) {
    ASSERT_TRUE(WriteFileAtomically(folder_ / "link.json", content));
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link.json"));
    EXPECT_EQ(Content(folder_ / "far/target.json"), content);
  }
}

TEST_F(AtomicFile, NeverReplacesADevice) {
  ASSERT_TRUE(WriteFileAtomically("/dev/null", "x"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(AtomicFile, MissingFolderIsTheUsersError) {
  const Result<void> written = WriteFileAtomically(folder_ / "no" / "out.json", "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::kInput);
  EXPECT_THAT(written.error().Message(), HasSubstr("out.json: cannot write"));
}

TEST_F(AtomicFile, TargetThatIsAFolderLeavesNoTemporaryFile) {
  std::filesystem::create_directories(folder_ / "out.json" / "inside");
  EXPECT_FALSE(WriteFileAtomically(folder_ / "out.json", "x"));
  EXPECT_EQ(FilesInFolder(), 1U);
}

// A limit on the file size interrupts the write, as a full disk does.
TEST_F(AtomicFile, WriteThatStopsHalfwayKeepsTheOldFileAndNoPart) {
  ASSERT_TRUE(WriteFileAtomically(folder_ / "out.bin", "old"));
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100'000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Result<void> written =
      WriteFileAtomically(folder_ / "out.bin", std::string(1'000'000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_FALSE(written);
  EXPECT_EQ(Content(folder_ / "out.bin"), "old");
  EXPECT_EQ(FilesInFolder(), 1U);
}

TEST_F(AtomicFile, FullDiskIsTheMachinesErrorAndMissingPermissionTheUsers) {
  EXPECT_EQ(WriteError("a", ENOSPC).kind, ErrorKind::kSystem);
  EXPECT_EQ(WriteError("a", EDQUOT).kind, ErrorKind::kSystem);
  EXPECT_THAT(WriteError("a", ENOSPC).Message(), HasSubstr("free some space"));
  EXPECT_EQ(WriteError("a", EACCES).kind, ErrorKind::kInput);
  EXPECT_THAT(WriteError("a", EACCES).Message(), HasSubstr("a folder that you may write to"));
}

TEST_F(AtomicFile, TemporaryNameKeepsTheExtensionThatEncodersLookAt) {
  const std::filesystem::path temporary = TemporarySibling("/x/composite.mp4");
  EXPECT_EQ(temporary.extension(), ".mp4");
  EXPECT_EQ(temporary.parent_path(), "/x");
  EXPECT_NE(temporary.filename(), "composite.mp4");
}

}  // namespace
}  // namespace pleinair
