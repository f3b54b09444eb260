#include <gmock/gmock.h>

#include <string>

#include "scene/scene_facts.h"
#include "tests/error_message.h"

namespace pleinair::scene {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Result<SceneFacts> WithTrajectory(const std::string& keys) {
  return ParseSceneToml("[trajectory]\n" + keys, "site/scene.toml");
}

TEST(TomlTrajectory, ReadsEveryKey) {
  const auto read = WithTrajectory(
      "file = \"scan\"\nformat = \"stray\"\npoints = \"../places.txt\"\noffset_s = -0.25\n"
      "scale = 0.5\nturn_deg = 90\nmax_gap_s = 0.6\nframe_rate_hz = 2\nextrinsics = \"s.yaml\"\n");
  ASSERT_TRUE(read) << read.error().Message();
  ASSERT_TRUE(read->trajectory);
  const TrajectoryDescription& trajectory = *read->trajectory;
  EXPECT_EQ(trajectory.file, "site/scan");
  EXPECT_EQ(trajectory.format, "stray");
  EXPECT_EQ(trajectory.points, "places.txt");
  EXPECT_EQ(trajectory.extrinsics, "site/s.yaml");
  EXPECT_EQ(trajectory.offset_s, -0.25);
  EXPECT_EQ(trajectory.scale, 0.5);
  EXPECT_FALSE(trajectory.is_scale_free);
  EXPECT_EQ(trajectory.turn_deg, 90);
  EXPECT_EQ(trajectory.max_gap_s, 0.6);
  EXPECT_EQ(trajectory.frame_rate_hz, 2.0);
}

TEST(TomlTrajectory, TheScaleMayBeFree) {
  const auto read = WithTrajectory("file = \"walk.tum\"\nscale = \"free\"\n");
  ASSERT_TRUE(read && read->trajectory);
  EXPECT_TRUE(read->trajectory->is_scale_free);
  EXPECT_FALSE(read->trajectory->scale);
}

TEST(TomlTrajectory, RefusesImpossibleValuesByLineAndKey) {
  const auto refused = [](const std::string& keys) {
    return tests::MessageOf(WithTrajectory("file = \"walk.tum\"\n" + keys));
  };
  EXPECT_THAT(tests::MessageOf(WithTrajectory("scale = 1\n")), HasSubstr("names no file"));
  EXPECT_THAT(refused("scale = 0\n"), AllOf(StartsWith("site/scene.toml:3"), HasSubstr("range")));
  EXPECT_THAT(refused("scale = \"big\"\n"), HasSubstr("neither a number nor"));
  EXPECT_THAT(refused("turn_deg = 45\n"), HasSubstr("no quarter turn"));
  EXPECT_THAT(refused("max_gap_s = nan\n"), StartsWith("site/scene.toml:3"));
  EXPECT_THAT(refused("offset_s = 1e12\n"), HasSubstr("range"));
  EXPECT_THAT(refused("speed = 1\n"), HasSubstr("is unknown"));
  EXPECT_THAT(refused("[[trajectory]]\nfile = \"b\"\n"), StartsWith("site/scene.toml"));
}

}  // namespace
}  // namespace pleinair::scene
