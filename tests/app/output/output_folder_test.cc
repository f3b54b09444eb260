#include "app/output/output_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>
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

  static void Write(const fs::path& file) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "x";
  }

  /// Writes a replay report with these outputs into the folder.
  void WriteReport(const std::string& outputs, int frames = 2) const {
    std::ofstream(root_ / "report.json") << R"({"program": "pleinair", "frames": )" << frames
                                         << R"(, "outputs": [)" << outputs << "]}";
  }

  /// Relative paths of everything below the folder.
  std::set<std::string> Files() const {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(root_)) {
      if (entry.is_regular_file()) files.insert(fs::relative(entry.path(), root_).string());
    }
    return files;
  }

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
  WriteReport(R"("report.json")");
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

TEST_F(OutputFolderTest, IsForOneReplayAtATime) {
  std::optional<OutputFolder> first = *OutputFolder::Create(root_ / "out");
  const auto second = OutputFolder::Create(root_ / "out");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().what, "another replay is writing into this folder");
  Write(first->staging() / "report.json");
  ASSERT_TRUE(first->Commit());
  first.reset();
  EXPECT_TRUE(fs::exists(root_ / "out/report.json"));
  fs::remove(root_ / "out/report.json");
  EXPECT_TRUE(OutputFolder::Create(root_ / "out"));
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

TEST_F(OutputFolderTest, AFolderThatIsARecordingIsRefusedAndKept) {
  for (const char* mark :
       {"recording.json", "scene.json", "data.csv", "mav0/body.yaml", "cam0/data.csv"}) {
    const fs::path site = root_ / fs::path(mark).stem() / "site";
    Write(site / mark);
    const auto folder = OutputFolder::Create(site);
    ASSERT_FALSE(folder) << mark;
    EXPECT_EQ(folder.error().kind, ErrorKind::kInput);
    EXPECT_NE(folder.error().what.find("is a recording"), std::string::npos);
    EXPECT_TRUE(fs::exists(site / mark));
  }
}

TEST_F(OutputFolderTest, AFolderOfARecordingsFramesIsRefusedUnderAnyName) {
  Write(root_ / "site/recording.json");
  Write(root_ / "site/frames/0000.JPG");
  fs::create_directory_symlink(root_ / "site/frames", root_ / "link");
  for (const char* name : {"site/frames", "site/frames/", "site/frames/../frames", "link"}) {
    const auto folder = OutputFolder::Create(root_ / name);
    ASSERT_FALSE(folder) << name;
    EXPECT_EQ(folder.error().kind, ErrorKind::kInput);
  }
  EXPECT_TRUE(OutputFolder::Create(root_ / "site/out"));
}

TEST_F(OutputFolderTest, AFileNamedLikeAnOutputThatNoReplayWroteIsRefused) {
  for (const char* name : {"composite.mp4", "frames/0000.png", "poses/tag36h11_0.tum"}) {
    WriteReport(R"("report.json")");
    Write(root_ / name);
    const auto folder = OutputFolder::Create(root_);
    ASSERT_FALSE(folder) << name;
    EXPECT_EQ(folder.error().kind, ErrorKind::kInput);
    EXPECT_EQ(folder.error().where, (root_ / name).string());
    fs::remove_all(root_ / fs::path(name).begin()->string());
  }
}

TEST_F(OutputFolderTest, AReportThatIsNoReplaysIsRefused) {
  for (const char* text : {"", "x", "[]", R"({"program": "other", "outputs": ["report.json"]})",
                           R"({"program": "pleinair", "outputs": "report.json"})"}) {
    std::ofstream(root_ / "report.json") << text;
    const auto folder = OutputFolder::Create(root_);
    ASSERT_FALSE(folder) << text;
    EXPECT_EQ(folder.error().where, (root_ / "report.json").string());
  }
}

TEST_F(OutputFolderTest, FramesAreRemovedOnlyAsFarAsTheReportCountsThem) {
  WriteReport(R"("frames/%04d.png", "report.json")", 2);
  for (const char* name : {"frames/0000.png", "frames/0001.png", "frames/mine.png"}) {
    Write(root_ / name);
  }
  {
    auto folder = OutputFolder::Create(root_);
    ASSERT_TRUE(folder) << folder.error().Message();
    Write(folder->staging() / "composite.mp4");
    ASSERT_TRUE(folder->Commit());
  }
  EXPECT_EQ(Files(), (std::set<std::string>{"composite.mp4", "frames/mine.png"}));
  WriteReport(R"("frames/%04d.png", "composite.mp4", "report.json")", 2);
  Write(root_ / "frames/0002.png");
  EXPECT_FALSE(OutputFolder::Create(root_));
}

TEST_F(OutputFolderTest, StagingOfDeadProcessesIsRemovedAndThatOfLivingOnesKept) {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);  // From here on no process has this id.
  const auto staging = [&](pid_t process) {
    return root_ / (".pleinair.part" + std::to_string(process));
  };
  Write(staging(child) / "frames/0000.png");
  Write(staging(getpid()) / "composite.mp4");
  Write(staging(getppid()) / "composite.mp4");
  Write(root_ / ".pleinair.partner/notes");
  {
    const auto folder = OutputFolder::Create(root_);
    ASSERT_TRUE(folder) << folder.error().Message();
    EXPECT_FALSE(fs::exists(staging(child)));
    EXPECT_TRUE(fs::is_empty(folder->staging()));
  }
  EXPECT_TRUE(fs::exists(staging(getppid()) / "composite.mp4"));
  EXPECT_TRUE(fs::exists(root_ / ".pleinair.partner/notes"));
}

TEST_F(OutputFolderTest, AFilePutInTheWayDuringTheReplayStays) {
  auto folder = OutputFolder::Create(root_ / "out");
  ASSERT_TRUE(folder);
  Write(folder->staging() / "composite.mp4");
  std::ofstream(root_ / "out/composite.mp4") << "mine";
  const auto committed = folder->Commit();
  ASSERT_FALSE(committed);
  EXPECT_EQ(committed.error().kind, ErrorKind::kInput);
  EXPECT_EQ(fs::file_size(root_ / "out/composite.mp4"), 4U);
}

TEST_F(OutputFolderTest, AResumableOneThatCannotBeMovedIsKeptWhole) {
  WriteReport(R"("light.csv", "report.json")");
  auto folder = OutputFolder::Create(root_, true);
  ASSERT_TRUE(folder);
  Write(folder->staging() / ".resume/identity");
  for (const char* file : {"frames/0000.png", "composite.mp4", "light.csv"}) {
    Write(folder->staging() / file);
  }
  Write(root_ / "light.csv/in_the_way");  // Files before it in the alphabet are moved by then.
  ASSERT_FALSE(folder->Commit());
  EXPECT_THAT(Files(),
              ::testing::UnorderedElementsAre(
                  "light.csv/in_the_way", "unfinished/.resume/identity", "unfinished/composite.mp4",
                  "unfinished/frames/0000.png", "unfinished/light.csv"));
  EXPECT_FALSE(fs::exists(root_ / "frames"));
}

}  // namespace
}  // namespace pleinair::app
