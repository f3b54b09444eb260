#include "app/sinks/output_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

class OutputFolderTest : public ::testing::Test {
 protected:
  OutputFolderTest() {
    std::string pattern = (fs::temp_directory_path() / "pleinair-app-XXXXXX").string();
    root_ = mkdtemp(pattern.data());
  }
  ~OutputFolderTest() override { fs::remove_all(root_); }

  static void Write(const fs::path& file) { std::ofstream(file) << "x"; }

  fs::path root_;
};

TEST_F(OutputFolderTest, WithoutCommitLeavesNoTraceOfFoldersItMade) {
  {
    auto folder = OutputFolder::Create(root_ / "a/b/c");
    ASSERT_TRUE(folder) << folder.error().Message();
    Write(folder->staging() / "composite.mp4");
    EXPECT_TRUE(fs::exists(root_ / "a/b/c"));
  }
  EXPECT_FALSE(fs::exists(root_ / "a"));
}

TEST_F(OutputFolderTest, WithoutCommitKeepsAFolderThatWasThereAndItsFiles) {
  Write(root_ / "report.json");
  {
    auto folder = OutputFolder::Create(root_);
    ASSERT_TRUE(folder);
    Write(folder->staging() / "report.json");
  }
  EXPECT_TRUE(fs::exists(root_ / "report.json"));
  EXPECT_EQ(std::distance(fs::directory_iterator(root_), {}), 1);
}

TEST_F(OutputFolderTest, CommitMovesFilesAndFoldersToTheirPlace) {
  auto folder = OutputFolder::Create(root_ / "out/");
  ASSERT_TRUE(folder);
  ASSERT_TRUE(folder->MakeFolder("poses"));
  Write(folder->staging() / "poses/tag36h11_0.tum");
  Write(folder->staging() / "report.json");
  ASSERT_TRUE(folder->Commit());
  EXPECT_TRUE(fs::exists(root_ / "out/poses/tag36h11_0.tum"));
  EXPECT_TRUE(fs::exists(root_ / "out/report.json"));
  EXPECT_EQ(std::distance(fs::directory_iterator(root_ / "out"), {}), 2);
}

TEST_F(OutputFolderTest, ErrorsNameTheTargetNotTheHiddenFile) {
  auto folder = OutputFolder::Create(root_ / "out");
  ASSERT_TRUE(folder);
  const Error told = folder->InTermsOfTarget(
      {ErrorKind::kSystem, (folder->staging() / "composite.mp4").string(), "full", ""});
  EXPECT_EQ(told.where, (root_ / "out/composite.mp4").string());
}

TEST_F(OutputFolderTest, AFileInTheWayIsAnInputError) {
  Write(root_ / "file");
  const auto folder = OutputFolder::Create(root_ / "file");
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().kind, ErrorKind::kInput);
}

}  // namespace
}  // namespace pleinair::app
