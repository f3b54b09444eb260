#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/quaternion.h"
#include "tests/e2e/marker_recording.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"
#include "tests/e2e/tum_file.h"

namespace pleinair::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int kWalkFrames = 12;
constexpr double kWalkRate_hz = 30.0;

Mat3 AboutAxis(Vec3 axis, double angle) {
  const Vec3 a = Normalized(axis) * std::sin(angle / 2);
  return RotationOf({a.x, a.y, a.z, std::cos(angle / 2)});
}

CameraModel WalkLens() {
  CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 700.0;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

/// A camera that moves two centimetres a frame and turns beside.
Transform<Camera, Marker> WalkPose(int frame) {
  const Mat3 turn = AboutAxis({0, 1, 0}, 0.01 * frame) * AboutAxis({1, 0, 0}, -2.3);
  return {turn, {-0.12 + 0.02 * frame, 0.03, 0.8 - 0.01 * frame}};
}

/// The walk as another program has it: in its frame of reference and its unit.
struct WalkWorld;
Transform<WalkWorld, Camera> WalkPoseInWorld(int frame, double unit_m) {
  const Transform<WalkWorld, Marker> world_from_marker{AboutAxis({1, 2, -0.5}, 1.3), {2, -1, 4}};
  Transform<WalkWorld, Camera> pose = world_from_marker * WalkPose(frame).Inverse();
  pose.translation_m = pose.translation_m * (1.0 / unit_m);
  return pose;
}

/// A recording whose frames `seen` show the marker.
void WriteWalk(const fs::path& folder, const std::set<int>& seen) {
  std::vector<std::vector<ShownMarker>> frames(kWalkFrames);
  for (const int i : seen) frames[static_cast<std::size_t>(i)].push_back({17, WalkPose(i)});
  WriteMarkerRecording(folder, WalkLens(), frames);
}

std::string Seven(Vec3 t, const Quaternion& q, const char* separator) {
  return fmt::format("{1:.12g}{0}{2:.12g}{0}{3:.12g}{0}{4:.12g}{0}{5:.12g}{0}{6:.12g}{0}{7:.12g}",
                     separator, t.x, t.y, t.z, q.x, q.y, q.z, q.w);
}

std::string WalkAsTum(double clock_s, double unit_m = 1.0) {
  std::string text;
  for (int i = 0; i < kWalkFrames; ++i) {
    const auto pose = WalkPoseInWorld(i, unit_m);
    text += fmt::format("{:.9f} {}\n", clock_s + i / kWalkRate_hz,
                        Seven(pose.translation_m, QuaternionOf(pose.rotation), " "));
  }
  return text;
}

std::string WalkAsEuroc() {
  std::string text = "#timestamp,p_x,p_y,p_z,q_w,q_x,q_y,q_z\n";
  for (int i = 0; i < kWalkFrames; ++i) {
    const auto pose = WalkPoseInWorld(i, 1.0);
    const Vec3 t = pose.translation_m;
    const Quaternion q = QuaternionOf(pose.rotation);
    text += fmt::format("{},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}\n",
                        std::llround(i * 1e9 / kWalkRate_hz), t.x, t.y, t.z, q.w, q.x, q.y, q.z);
  }
  return text;
}

std::string WalkAsStray() {
  std::string text = "timestamp, frame, x, y, z, qx, qy, qz, qw\n";
  for (int i = 0; i < kWalkFrames; ++i) {
    const auto pose = WalkPoseInWorld(i, 1.0);
    text += fmt::format("{:.6f}, {:06}, {}\n", 71234.5 + i / kWalkRate_hz, i,
                        Seven(pose.translation_m, QuaternionOf(pose.rotation), ", "));
  }
  return text;
}

std::string WalkAsRecord3d() {
  nlohmann::json metadata{{"fps", 30}, {"w", 640}, {"h", 480}, {"poses", nlohmann::json::array()}};
  for (int i = 0; i < kWalkFrames; ++i) {
    const auto pose = WalkPoseInWorld(i, 1.0);
    // The camera of ARKit: half a turn about x.
    const Quaternion q = QuaternionOf(pose.rotation * Mat3{{1, 0, 0, 0, -1, 0, 0, 0, -1}});
    const Vec3 t = pose.translation_m;
    metadata["poses"].push_back({q.x, q.y, q.z, q.w, t.x, t.y, t.z});
  }
  return metadata.dump();
}

/// COLMAP has camera-from-world poses.
void WriteWalkAsColmap(const fs::path& folder, double unit_m) {
  WriteFile(folder / "cameras.txt", "1 PINHOLE 640 480 700 700 320 240\n");
  std::string images;
  for (int i = 0; i < kWalkFrames; ++i) {
    const auto pose = WalkPoseInWorld(i, unit_m).Inverse();
    const Quaternion q = QuaternionOf(pose.rotation);
    const Vec3 t = pose.translation_m;
    images +=
        fmt::format("{} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} {:.12g} 1 {:04}.jpg\n\n",
                    i + 1, q.w, q.x, q.y, q.z, t.x, t.y, t.z, i);
  }
  WriteFile(folder / "images.txt", images);
  WriteFile(folder / "points3D.txt", "# none\n");
}

void ExpectWalk(const fs::path& tum) {
  const std::vector<TumPose> poses = ReadTum(tum);
  ASSERT_EQ(poses.size(), static_cast<std::size_t>(kWalkFrames)) << tum;
  for (int i = 0; i < kWalkFrames; ++i) {
    const Transform<Camera, Marker> truth = WalkPose(i);
    const Transform<Camera, Marker> found =
        poses[static_cast<std::size_t>(i)].marker_from_camera.Inverse();
    EXPECT_LT(Norm(found.translation_m - truth.translation_m), 0.002) << tum << " frame " << i;
    const Direction<Marker> up{{0, 0, 1}}, right{{1, 0, 0}};
    constexpr double kMaxTurn = 0.008;
    EXPECT_LT(Norm((found * up).xyz - (truth * up).xyz), kMaxTurn) << tum << " frame " << i;
    EXPECT_LT(Norm((found * right).xyz - (truth * right).xyz), kMaxTurn) << tum << " frame " << i;
  }
}

RunResult ReplayAlong(const TemporaryFolder& folder, const std::string& name,
                      std::vector<std::string> options) {
  std::vector<std::string> arguments = {
      "replay",     folder / "site", "-o",         folder / ("out_" + name),
      "--no-video", "--trajectory",  folder / name};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return RunPleinair(arguments);
}

TEST(Trajectory, EveryFormatPlacesAllFramesByOneViewOfTheMarker) {
  const TemporaryFolder folder;
  WriteWalk(folder / "site", {7});
  WriteFile(folder / "walk.tum", WalkAsTum(0.0));
  WriteFile(folder / "clock.tum", WalkAsTum(1305031098.0));
  WriteFile(folder / "walk.csv", WalkAsEuroc());
  fs::create_directories(folder / "stray");
  fs::create_directories(folder / "record3d");
  WriteFile(folder.path() / "stray/odometry.csv", WalkAsStray());
  WriteFile(folder.path() / "record3d/metadata", WalkAsRecord3d());
  for (const char* name : {"walk.tum", "clock.tum", "walk.csv", "stray", "record3d"}) {
    const RunResult run = ReplayAlong(folder, name, {});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const fs::path out = folder / (std::string("out_") + name);
    ExpectWalk(out / "poses/trajectory.tum");
    const std::string sources = ReadFile(out / "poses/sources.csv");
    EXPECT_THAT(sources, HasSubstr("\n7,0.233333333,trajectory,1,"));
    EXPECT_THAT(sources, HasSubstr("\n8,0.266666667,trajectory,0,"));
    const auto report = nlohmann::json::parse(ReadFile(out / "report.json"));
    EXPECT_EQ(report["frames_with_pose"], kWalkFrames);
    EXPECT_EQ(report["trajectory"]["frames_without_marker"], kWalkFrames - 1);
    EXPECT_EQ(report["trajectory"]["aligned_by"], "marker");
    EXPECT_LT(report["trajectory"]["centre_deviation_m"].get<double>(), 0.01);
  }
}

TEST(Trajectory, AReconstructionGetsItsScaleFromTwoViews) {
  const TemporaryFolder folder;
  WriteWalk(folder / "site", {1, 11});
  fs::create_directories(folder / "sparse");
  WriteWalkAsColmap(folder / "sparse", 0.31);
  const RunResult run = ReplayAlong(folder, "sparse", {});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ExpectWalk(folder.path() / "out_sparse/poses/trajectory.tum");
  const auto report = nlohmann::json::parse(ReadFile(folder.path() / "out_sparse/report.json"));
  EXPECT_NEAR(report["trajectory"]["marker_from_trajectory"]["scale"].get<double>(), 0.31, 0.002);
  EXPECT_EQ(report["trajectory"]["matched_by"], "frame");
}

TEST(Trajectory, ThreePlacesInTheSceneFileNeedNoMarker) {
  const TemporaryFolder folder;
  WriteWalk(folder / "site", {});
  fs::create_directories(folder.path() / "site/sparse");
  WriteWalkAsColmap(folder.path() / "site/sparse", 0.31);
  std::string places = "# trajectory, marker\n";
  for (const Vec3 at : {Vec3{0, 0, 0}, Vec3{0.5, 0.1, 0}, Vec3{-0.2, 0.6, 0.3}}) {
    const Vec3 moved = (WalkPoseInWorld(0, 0.31) *
                        Point<Camera>{(WalkPose(0) * Point<Marker>{at}).xyz * (1.0 / 0.31)})
                           .xyz;
    places += fmt::format("{:.9f}, {:.9f}, {:.9f}, {}, {}, {}\n", moved.x, moved.y, moved.z, at.x,
                          at.y, at.z);
  }
  WriteFile(folder.path() / "site/places.txt", places);
  WriteFile(folder.path() / "site/scene.toml",
            ReadFile(folder.path() / "site/scene.toml") +
                "[trajectory]\nfile = \"sparse\"\npoints = \"places.txt\"\n");
  const RunResult run = RunPleinair(
      {"replay", folder / "site", "-o", folder / "out", "--no-video", "--from", "0.05"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto report = nlohmann::json::parse(ReadFile(folder.path() / "out/report.json"));
  EXPECT_EQ(report["trajectory"]["aligned_by"], "places");
  EXPECT_EQ(report["frames_with_pose"], kWalkFrames - 2);
  EXPECT_EQ(report["marker"], nullptr);
}

/// The line of a check's output about a subject, with its remedy.
std::string FindingOn(const std::string& subject, const std::string& out) {
  const std::size_t at = out.find(subject + ": ");
  return at == std::string::npos ? "" : out.substr(at, out.find("\n", out.find('\n', at) + 1) - at);
}

TEST(Trajectory, CheckSaysWhetherItFitsTheFilm) {
  const TemporaryFolder folder;
  WriteWalk(folder / "site", {2, 7});
  WriteFile(folder / "site/walk.tum", WalkAsTum(0.0));
  const std::string scene = ReadFile(folder / "site/scene.toml");
  const auto finding = [&](const std::string& keys) {
    WriteFile(folder / "site/scene.toml", scene + "[trajectory]\n" + keys);
    return FindingOn("trajectory", RunPleinair({"check", folder / "site"}).out);
  };
  EXPECT_THAT(finding("file = \"walk.tum\"\noffset_s = 0\n"),
              HasSubstr("good: it has the pose of 12 of 12"));
  EXPECT_THAT(finding("file = \"walk.tum\"\n"), HasSubstr("doubtful: it has the pose of 12 of 12"));
  EXPECT_THAT(finding("file = \"walk.tum\"\noffset_s = 60\n"), HasSubstr("bad: "));
  WriteFile(folder / "site/scene.toml", scene + "[trajectory]\nfile = \"none.tum\"\n");
  ExpectRefused(RunPleinair({"check", folder / "site"}), "none.tum");
}

TEST(Trajectory, CheckEstimatesTheOffsetOfAWalkThatShowsTheMarkerShortly) {
  const TemporaryFolder folder;
  constexpr int kFrames = 240, kFirst = 110, kSeen = 18;
  const auto pose = [](int frame) { return WalkPose(frame - kFirst - 3); };
  std::vector<std::vector<ShownMarker>> frames(kFrames);
  for (int i = kFirst; i < kFirst + kSeen; ++i) {
    frames[static_cast<std::size_t>(i)].push_back({17, pose(i)});
  }
  CameraModel small = WalkLens();
  small.width /= 4;
  small.height /= 4;
  small.fx = small.fy = 175.0;
  small.cx = 79.5;
  small.cy = 59.5;
  WriteMarkerRecording(folder / "site", small, frames, "[trajectory]\nfile = \"walk.tum\"\n");
  std::string walk;
  for (int i = 0; i < kFrames; ++i) {
    const auto at = pose(i).Inverse();
    walk += fmt::format("{:.9f} {}\n", 0.1 + i / kWalkRate_hz,
                        Seven(at.translation_m, QuaternionOf(at.rotation), " "));
  }
  WriteFile(folder / "site/walk.tum", walk);
  const RunResult check = RunPleinair({"check", folder / "site"});
  EXPECT_THAT(FindingOn("trajectory", check.out),
              testing::ContainsRegex("good: .*offset of its clock -0.(09|10).*, estimated within"));
}

TEST(Trajectory, LivePlaysARecordingAlongItAndRefusesACamera) {
  const TemporaryFolder folder;
  WriteWalk(folder / "site", {2, 7});
  WriteFile(folder / "site/walk.tum", WalkAsTum(0.0));
  const std::string scene = ReadFile(folder / "site/scene.toml");
  WriteFile(folder / "site/scene.toml", scene + "[trajectory]\nfile = \"walk.tum\"\n");
  const RunResult live = RunPleinair({"live", "--camera", "file:" + (folder / "site").string(),
                                      "--headless", "--lossless", "--json"});
  ASSERT_EQ(live.exit_code, 0) << live.err;
  EXPECT_THAT(live.out, HasSubstr("it has the pose of 12 of 12 frames"));
  EXPECT_THAT(live.out, HasSubstr("\"with_pose\":12"));
  WriteFile(folder / "camera.json", R"({"image_width": 640, "image_height": 480,
      "model": "opencv-radtan", "fx": 700, "fy": 700, "cx": 319.5, "cy": 239.5,
      "distortion_k1_k2_p1_p2_k3": [0, 0, 0, 0, 0]})");
  ExpectRefused(RunPleinair({"live", "--camera", "v4l2:/dev/video0", "--headless", "--calibration",
                             folder / "camera.json", "--scene", folder / "site/scene.toml"}),
                "belongs to a recording, not to a camera");
}

/// One walk for all refusals.
class TrajectoryRefusal : public testing::TestWithParam<Refusal> {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    const TemporaryFolder& folder = *folder_;
    WriteWalk(folder / "site", {7});
    WriteFile(folder / "walk.tum", WalkAsTum(0.0));
    WriteFile(folder / "nan.tum", "0 0 0 nan 0 0 0 1\n");
    WriteFile(folder / "zero.tum", "0 0 0 0 0 0 0 0\n");
    WriteFile(folder / "unordered.tum", "1 0 0 0 0 0 0 1\n0 0 0 0 0 0 0 1\n");
    WriteFile(folder / "cut.tum", WalkAsTum(0.0).substr(0, 400));
    WriteFile(folder / "cut.json", WalkAsRecord3d().substr(0, 200));
    WriteFile(folder / "line.txt", "0 0 0 0 0 0\n1 0 0 1 0 0\n2 0 0 2 0 0\n");
    WriteFile(folder / "two.txt", "0 0 0 0 0 0\n1 0 0 1 0 0\n");
    fs::create_directories(folder / "sparse");
    WriteWalkAsColmap(folder / "sparse", 0.31);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  inline static std::unique_ptr<TemporaryFolder> folder_;
};

TEST_P(TrajectoryRefusal, IsOneLineAndLeavesNothing) {
  const TemporaryFolder& folder = *folder_;
  std::vector<std::string> arguments = {"replay", folder / "site", "-o", folder / "out",
                                        "--no-video"};
  for (std::string argument : GetParam().arguments) {
    if (argument.find('.') != std::string::npos || argument == "sparse") {
      argument = folder / argument;
    }
    arguments.push_back(argument);
  }
  ExpectRefused(RunPleinair(arguments), GetParam().message);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

INSTANTIATE_TEST_SUITE_P(
    Files, TrajectoryRefusal,
    testing::Values(Refusal{"missing", {"--trajectory", "none.tum"}, "none.tum"},
                    Refusal{"nan", {"--trajectory", "nan.tum"}, "nan.tum:1: field 4 (\"nan\")"},
                    Refusal{"zero", {"--trajectory", "zero.tum"}, "a quaternion of length 0"},
                    Refusal{"unordered",
                            {"--trajectory", "unordered.tum"},
                            "is not later than the pose before"},
                    Refusal{"cut", {"--trajectory", "cut.tum"}, "cut.tum:4: has"},
                    Refusal{"cut_json", {"--trajectory", "cut.json"}, "is not a JSON object"},
                    Refusal{"other_format",
                            {"--trajectory", "walk.tum", "--trajectory-format", "stray"},
                            "is no odometry.csv of Stray Scanner"},
                    Refusal{"one_view", {"--trajectory", "sparse"}, "has no scale"},
                    Refusal{"other_time",
                            {"--trajectory", "walk.tum", "--trajectory-offset-s", "3600"},
                            "has no pose in any frame that shows the marker"},
                    Refusal{"line",
                            {"--trajectory", "walk.tum", "--trajectory-points", "line.txt"},
                            "lie on a line"},
                    Refusal{"two",
                            {"--trajectory", "walk.tum", "--trajectory-points", "two.txt"},
                            "holds 2 places"}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace pleinair::e2e
