// What a command may replace: docs/guide/reference/outputs.md, "What is replaced".

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kSun = {"sun", "--at", "50,14", "--time", "2025-09-14T11:05:00Z"};

std::vector<std::string> SunTo(const std::string& file) {
  std::vector<std::string> arguments = kSun;
  arguments.insert(arguments.end(), {"-o", file});
  return arguments;
}

TEST(OutputRule, AFileThatTheUserNamesIsReplacedAlsoThroughALink) {
  const TemporaryFolder folder;
  WriteFile(folder / "sun.csv", "old");
  fs::create_symlink("sun.csv", folder / "link.csv");
  ASSERT_EQ(RunPleinair(SunTo(folder / "link.csv")).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
  EXPECT_THAT(ReadFile(folder / "sun.csv"), testing::HasSubstr("azimuth"));
}

TEST(OutputRule, TheInputIsNeverReplacedUnderAnyName) {
  const TemporaryFolder folder;
  const std::string table = "utc,lat,lon\n2025-09-14T11:05:00Z,50,14\n";
  WriteFile(folder / "in.csv", table);
  fs::create_symlink("in.csv", folder / "link.csv");
  for (const char* name : {"in.csv", "./in.csv", "link.csv"}) {
    ExpectRefused(RunPleinair({"sun", "--csv", folder / "in.csv", "-o", folder / name}),
                  "is the input itself");
    EXPECT_EQ(ReadFile(folder / "in.csv"), table);
  }
  WriteFile(folder / "camera.json", "mine");
  ExpectRefused(RunPleinair({"live", "--camera", "v4l2:/dev/video9", "--calibration",
                             folder / "camera.json", "--detections", folder / "camera.json"}),
                "is the input itself");
  EXPECT_EQ(ReadFile(folder / "camera.json"), "mine");
}

TEST(OutputRule, AFileInAFolderThatIsReadIsNotReplaced) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "site");
  WriteFile(folder / "site/recording.json", "{}");
  WriteFile(folder / "site/scene.toml", "mine");
  for (const char* recording : {"site", "site/recording.json"}) {
    ExpectRefused(RunPleinair({"response", folder / recording, "-o", folder / "site/scene.toml"}),
                  "is a file in a folder that this command reads");
  }
  EXPECT_EQ(ReadFile(folder / "site/scene.toml"), "mine");
}

TEST(OutputRule, OneFileIsNotTwoOutputs) {
  const TemporaryFolder folder;
  ExpectRefused(RunPleinair({"calibrate", "--charuco", "8x6", folder / "photos", "-o",
                             folder / "a.json", "--report", folder / "./a.json"}),
                "is named twice");
}

TEST(OutputRule, AnEmptyNameIsRefusedWithItsOption) {
  ExpectRefused(RunPleinair(SunTo("")), "--output: is given without a value");
  ExpectRefused(RunPleinair({"accuracy", "--quick", "-o", ""}), "--output: the name is empty");
  ExpectRefused(RunPleinair({"replay", "none", "-o", ""}), "--output: the name is empty");
}

TEST(OutputRule, AnAccuracyRunReplacesNoFilesOfOthers) {
  const TemporaryFolder folder;
  for (const char* name : {"report.json", "records.jsonl"}) {
    const std::string mine = std::string("my ") + name;
    fs::create_directory(folder / "out");
    WriteFile(folder / "out" / name, mine);
    ExpectRefused(RunPleinair({"accuracy", folder / "none", "-o", folder / "out"}),
                  std::string(name) + ": is there already");
    EXPECT_EQ(ReadFile(folder / "out" / name), mine);
    EXPECT_THAT(Listing(folder / "out"), testing::ElementsAre(name));
    fs::remove_all(folder / "out");
  }
  WriteFile(folder / "recording.json", "{}");
  ExpectRefused(RunPleinair({"accuracy", "--quick", "-o", folder / "."}), "is a recording");
}

TEST(OutputRule, AShadowBenchReplacesNoFilesOfOthers) {
  const TemporaryFolder folder;
  for (const char* name : {"shadows.jsonl", "trees_methods.jpg", "trees_zgaf_partitions.jpg"}) {
    fs::create_directory(folder / "out");
    WriteFile(folder / "out" / name, "mine");
    ExpectRefused(
        RunPleinair({"bench", "shadows", "--quick", "--scenes", "trees", "-o", folder / "out"}),
        std::string(name) + ": is there already");
    EXPECT_THAT(Listing(folder / "out"), testing::ElementsAre(name));
    fs::remove_all(folder / "out");
  }
}

TEST(OutputRule, AColmapModelReplacesNoFilesOfOthers) {
  const TemporaryFolder folder;
  WriteFile(folder / "path.tum", "0 0 0 1 0 0 0 1\n1 0 0 2 0 0 0 1\n");
  WriteFile(folder / "camera.json",
            R"({"image_width": 640, "image_height": 480, "fx": 600, "fy": 600, "cx": 319.5, )"
            R"("cy": 239.5})");
  fs::create_directory(folder / "model");
  WriteFile(folder / "model/images.txt", "my list of images");
  const std::vector<std::string> convert = {"path",
                                            "convert",
                                            folder / "path.tum",
                                            (folder / "model/").string(),
                                            "--calibration",
                                            folder / "camera.json"};
  ExpectRefused(RunPleinair(convert), "images.txt: is there already and will not be overwritten");
  EXPECT_EQ(ReadFile(folder / "model/images.txt"), "my list of images");
  EXPECT_THAT(Listing(folder / "model"), testing::ElementsAre("images.txt"));
  fs::remove(folder / "model/images.txt");
  EXPECT_EQ(RunPleinair(convert).exit_code, 0);
  EXPECT_EQ(RunPleinair(convert).exit_code, 0);  // The same model again.
}

}  // namespace
}  // namespace pleinair::e2e
