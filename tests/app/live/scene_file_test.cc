#include "app/live/scene_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/temporary_folder.h"

namespace pleinair::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = R"(# kept
time = 2025-09-14T13:05:00+02:00
place = {latitude_deg = 50, longitude_deg = 14}
marker = {size_mm = 480, heading_deg = 0}
[[object]]
file = "chair.obj"
translation_m = [0, 0, 0]
)";

std::string TextOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class SceneFileTest : public testing::Test {
 protected:
  SceneFileTest() {
    folder_.Write("chair.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    path_ = folder_.Write("scene.toml", kScene);
    scene_ = scene::ReadSceneDescription(path_).value();
    unedited_ = moved_ = session::UneditedScene(scene_, {});
    moved_.objects[0].translation_m = {0.25, 0.0, 0.0};
  }

  SceneFile Open(const fs::path& target = {}) const {
    return SceneFile::Open(scene_, unedited_, target).value();
  }

  tests::TemporaryFolder folder_;
  fs::path path_;
  scene::SceneDescription scene_;
  session::SceneEdit unedited_, moved_;
};

TEST_F(SceneFileTest, SavesIntoTheScenesOwnFileAgainAndAgain) {
  SceneFile file = Open();
  EXPECT_TRUE(file.IsUnsaved(moved_));
  const auto saved = file.Save(moved_);
  ASSERT_TRUE(saved) << saved.error().Message();
  EXPECT_FALSE(file.IsUnsaved(moved_));
  EXPECT_EQ(scene::ReadSceneDescription(path_)->objects[0].translation_m.x, 0.25);
  EXPECT_EQ(TextOf(path_).substr(0, 7), "# kept\n");
  ASSERT_TRUE(file.Save(unedited_));
  EXPECT_EQ(scene::ReadSceneDescription(path_)->objects[0].translation_m.x, 0.0);
  for (const auto& entry : fs::directory_iterator(path_.parent_path())) {
    EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos);
  }
}

TEST_F(SceneFileTest, DoesNotOverwriteTheChangesOfAnotherProgram) {
  SceneFile file = Open();
  ASSERT_TRUE(file.Save(moved_));
  const std::string theirs = TextOf(path_) + "# by an editor\n";
  folder_.Write("scene.toml", theirs);
  const auto refused = file.Save(unedited_);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().Message().find("another program"), std::string::npos);
  EXPECT_EQ(TextOf(path_), theirs);
}

TEST_F(SceneFileTest, SavesIntoANewFileAndLeavesTheScenesOwn) {
  const fs::path target = path_.parent_path() / "moved.toml";
  SceneFile file = Open(target);
  ASSERT_TRUE(file.Save(moved_));
  ASSERT_TRUE(file.Save(moved_));
  EXPECT_EQ(TextOf(path_), kScene);
  EXPECT_EQ(scene::ReadSceneDescription(target)->objects[0].translation_m.x, 0.25);
  EXPECT_FALSE(SceneFile::Open(scene_, unedited_, target)) << "it exists";
  EXPECT_FALSE(SceneFile::Open(scene_, unedited_, "/moved.toml")) << "another folder";
}

TEST_F(SceneFileTest, ASceneWithoutATomlFileIsSavedIntoANewOne) {
  scene_.file = folder_.Write("scene.json", "{}");
  scene_.phantoms.clear();  // Such a file describes no surfaces.
  unedited_.phantoms.clear();
  moved_.phantoms.clear();
  const auto refused = Open().Save(moved_);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().Message().find("--save-scene"), std::string::npos);
  const fs::path target = path_.parent_path() / "new.toml";
  SceneFile file = Open(target);
  const auto saved = file.Save(moved_);
  ASSERT_TRUE(saved) << saved.error().Message();
  const auto read = scene::ReadSceneDescription(target);
  ASSERT_TRUE(read) << read.error().Message();
  EXPECT_EQ(read->objects[0].translation_m.x, 0.25);
  EXPECT_EQ(TextOf(scene_.file), "{}");
}

}  // namespace
}  // namespace pleinair::app
