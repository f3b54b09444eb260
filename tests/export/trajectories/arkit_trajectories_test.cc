#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "export/trajectories/record3d_trajectory.h"
#include "export/trajectories/stray_trajectory.h"
#include "export/trajectories/trajectory_files.h"
#include "tests/error_message.h"
#include "tests/source_tree.h"

namespace pleinair::exports {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using tests::MessageOf;

constexpr const char* kOdometry =
    "timestamp, frame, x, y, z, qx, qy, qz, qw, fx, fy, cx, cy, distortion_center_x, "
    "distortion_center_y\n"
    "71234.016689, 000000, 0.1, 1.5, -0.2, 1, 0, 0, 0, 1600.0, 1600.0, 960.0, 720.0, , \n"
    "71234.033356, 000001, 0.2, 1.5, -0.2, 1, 0, 0, 0, 1600.0, 1600.0, 960.0, 720.0, , \n";

constexpr const char* kMetadata =
    R"({"w": 720, "h": 960, "fps": 60, "K": [700, 0, 0, 0, 701, 0, 360.5, 480.5, 1],
        "frameTimestamps": [0.0, 0.0167],
        "poses": [[0, 0, 0, 1, 0.1, 1.5, -0.2], [0, 0, 0, 1, 0.2, 1.5, -0.2]]})";

/// A camera that a phone holds level looks along -z of ARKit's world, and its images are upright.
void ExpectLevelView(const Transform<Reference, Camera>& pose) {
  EXPECT_NEAR((pose * Direction<Camera>{{0, 0, 1}}).xyz.z, -1.0, 1e-12);
  EXPECT_NEAR((pose * Direction<Camera>{{0, 1, 0}}).xyz.y, -1.0, 1e-12);
  EXPECT_NEAR((pose * Direction<Camera>{{1, 0, 0}}).xyz.x, 1.0, 1e-12);
}

TEST(StrayTrajectory, HasCameraAxesOfImages) {
  const auto path = ParseStrayOdometry(kOdometry, "odometry.csv");
  ASSERT_TRUE(path) << path.error().Message();
  ASSERT_EQ(path->poses.size(), 2U);
  // ARKit's identity times the app's half turn about x.
  ExpectLevelView(path->poses[0].reference_from_camera);
  EXPECT_EQ(path->poses[0].reference_from_camera.translation_m, (Vec3{0.1, 1.5, -0.2}));
  EXPECT_EQ(path->poses[0].timestamp_ns, 71'234'016'689'000);
  EXPECT_EQ(path->poses[1].frame, 1);
}

TEST(StrayTrajectory, ReadsTheLensOfWholeImagesOnly) {
  const auto lens = ParseStrayCamera("1600.0, 0, 965.5\n0, 1601.0, 722.5\n0, 0, 1\n", "m.csv");
  ASSERT_TRUE(lens && *lens);
  EXPECT_EQ((*lens)->width, 1920);
  EXPECT_EQ((*lens)->cx, 965.0);
  EXPECT_EQ((*lens)->fy, 1601.0);
  const auto other = ParseStrayCamera("800, 0, 482\n0, 800, 361\n0, 0, 1\n", "m.csv");
  ASSERT_TRUE(other) << other.error().Message();
  EXPECT_FALSE(*other);
  EXPECT_THAT(MessageOf(ParseStrayCamera("1, 2, 3\n4, 5\n", "m.csv")), StartsWith("m.csv:2: "));
  EXPECT_THAT(MessageOf(ParseStrayCamera("1 2 3", "m.csv")), HasSubstr("holds no 3×3 matrix"));
}

TEST(StrayTrajectory, RefusesWhatIsNotOne) {
  const auto with = [](const std::string& line) {
    return MessageOf(ParseStrayOdometry("timestamp, frame, x, y, z, qx, qy, qz, qw\n" + line, "o"));
  };
  EXPECT_THAT(with(""), HasSubstr("holds no poses"));
  EXPECT_THAT(with("1, 0, 0, 0, 0, 0, 0, 0, 0\n"),
              AllOf(StartsWith("o:2: "), HasSubstr("length 0")));
  EXPECT_THAT(with("1, 0, 0, nan, 0, 0, 0, 0, 1\n"), HasSubstr("is not a finite number"));
  EXPECT_THAT(with("1, 0, 0, 0, 0, 0, 0, 0\n"), HasSubstr("fewer than 9"));
  EXPECT_THAT(with("2, 0, 0, 0, 0, 0, 0, 0, 1\n1, 1, 0, 0, 0, 0, 0, 0, 1\n"),
              AllOf(StartsWith("o:3: "), HasSubstr("is not later")));
  EXPECT_THAT(with("1, 3, 0, 0, 0, 0, 0, 0, 1\n2, 3, 0, 0, 0, 0, 0, 0, 1\n"),
              HasSubstr("frame number that does not ascend"));
  // The first versions wrote no times.
  EXPECT_THAT(MessageOf(ParseStrayOdometry("0, 0, 0, 0, 0, 0, 1\n", "o")),
              HasSubstr("lacks the header"));
}

TEST(Record3dTrajectory, TurnsTheCameraOfArkit) {
  const auto path = ParseRecord3dMetadata(kMetadata, "metadata");
  ASSERT_TRUE(path) << path.error().Message();
  ASSERT_EQ(path->poses.size(), 2U);
  ExpectLevelView(path->poses[0].reference_from_camera);
  EXPECT_EQ(path->poses[1].reference_from_camera.translation_m, (Vec3{0.2, 1.5, -0.2}));
  EXPECT_EQ(path->poses[1].timestamp_ns, 16'700'000);
  EXPECT_EQ(path->poses[1].frame, 1);
  ASSERT_TRUE(path->camera);
  EXPECT_EQ(path->camera->width, 720);
  EXPECT_EQ(path->camera->cy, 480.0);
  EXPECT_EQ(path->camera->fy, 701.0);
}

TEST(Record3dTrajectory, TakesTimesFromTheRateWhereThereAreNone) {
  const auto path = ParseRecord3dMetadata(
      R"({"fps": 50, "poses": [[0,0,0,1,0,0,0], [0,0,0,1,0,0,0]]})", "metadata");
  ASSERT_TRUE(path) << path.error().Message();
  EXPECT_EQ(path->poses[1].timestamp_ns, 20'000'000);
  EXPECT_FALSE(path->camera);
}

TEST(Record3dTrajectory, RefusesWhatIsNotOne) {
  const auto message = [](const std::string& json) {
    return MessageOf(ParseRecord3dMetadata(json, "m"));
  };
  EXPECT_THAT(message(std::string(kMetadata).substr(0, 100)), HasSubstr("is not a JSON object"));
  EXPECT_THAT(message("[]"), HasSubstr("is not a JSON object"));
  EXPECT_THAT(message(R"({"fps": 60})"), HasSubstr("holds no poses"));
  EXPECT_THAT(message(R"({"fps": 60, "poses": [[0,0,0,0,0,0,0]]})"), HasSubstr("length 0"));
  EXPECT_THAT(message(R"({"fps": 60, "poses": [[0,0,0,1,0,0,1e999]]})"), StartsWith("m: "));
  EXPECT_THAT(message(R"({"fps": 60, "poses": [[0,0,0,1,0,0]]})"),
              HasSubstr("is not seven numbers"));
  EXPECT_THAT(message(R"({"poses": [[0,0,0,1,0,0,0]]})"), HasSubstr("neither frameTimestamps"));
  EXPECT_THAT(message(R"({"frameTimestamps": [1], "poses": [[0,0,0,1,0,0,0],[0,0,0,1,0,0,0]]})"),
              HasSubstr("not one number per pose"));
  EXPECT_THAT(message(R"({"frameTimestamps": [2,1], "poses": [[0,0,0,1,0,0,0],[0,0,0,1,0,0,0]]})"),
              HasSubstr("is not later"));
}

TEST(TrajectoryFormats, KnowFilesAndFoldersOfArkit) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / ("arkit_" + std::to_string(getpid()));
  const auto write = [&](const char* name, const char* text) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  };
  write("scan/odometry.csv", kOdometry);
  write("scan/camera_matrix.csv", "1600, 0, 960\n0, 1600, 720\n0, 0, 1\n");
  write("renamed.csv", kOdometry);
  write("euroc.csv", "#timestamp\n1,0,0,0,1,0,0,0\n");
  write("walk/metadata", kMetadata);
  for (const char* stray : {"scan", "scan/odometry.csv", "renamed.csv"}) {
    EXPECT_EQ(TrajectoryFormatOf(folder / stray), TrajectoryFormat::kStray) << stray;
    EXPECT_TRUE(ReadTrajectory(folder / stray, TrajectoryFormat::kStray, {})) << stray;
  }
  EXPECT_TRUE(ReadTrajectory(folder / "scan", TrajectoryFormat::kStray, {})->camera);
  EXPECT_EQ(TrajectoryFormatOf(folder / "euroc.csv"), TrajectoryFormat::kEuroc);
  for (const char* record3d : {"walk", "walk/metadata"}) {
    EXPECT_EQ(TrajectoryFormatOf(folder / record3d), TrajectoryFormat::kRecord3d) << record3d;
    EXPECT_TRUE(ReadTrajectory(folder / record3d, TrajectoryFormat::kRecord3d, {}));
  }
  // A folder has one archive, or says which.
  const std::filesystem::path archive = tests::SourceTree() / "tests/fuzz/corpus/path/stored.r3d";
  std::filesystem::create_directories(folder / "shared");
  std::filesystem::copy_file(archive, folder / "shared/walk.r3d");
  EXPECT_EQ(TrajectoryFormatOf(folder / "shared"), TrajectoryFormat::kRecord3d);
  EXPECT_TRUE(ReadTrajectory(folder / "shared", TrajectoryFormat::kRecord3d, {}));
  std::filesystem::copy_file(archive, folder / "shared/other.R3D");
  EXPECT_THAT(MessageOf(TrajectoryFormatOf(folder / "shared")),
              HasSubstr("holds several .r3d archives"));
  write("shared/cameras.txt", "");
  EXPECT_EQ(TrajectoryFormatOf(folder / "shared"), TrajectoryFormat::kColmap);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace pleinair::exports
