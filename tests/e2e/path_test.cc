#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/camera_model.h"
#include "base/quaternion.h"
#include "tests/e2e/refusal.h"
#include "tests/e2e/run_program.h"
#include "tests/e2e/tum_file.h"
#include "tests/source_tree.h"

namespace pleinair::e2e {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::filesystem::path kTruth = BundledRecording() / "truth.tum";
// Off-centre principal point and non-square pixels.
constexpr const char* kLens =
    R"({"image_width": 640, "image_height": 480, "model": "opencv-radtan", "fx": 585, "fy": 640,
        "cx": 300.3, "cy": 275.8, "distortion_k1_k2_p1_p2_k3": [0, 0, 0, 0, 0]})";

RunResult Convert(const std::filesystem::path& from, const std::filesystem::path& to,
                  std::vector<std::string> options = {}) {
  std::vector<std::string> arguments = {"path", "convert", from, to};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return RunPleinair(arguments);
}

TEST(Path, GoesThroughEveryFormAndComesBack) {
  const TemporaryFolder folder;
  WriteFile(folder / "lens.json", kLens);
  const std::vector<std::string> lens = {"--calibration", folder / "lens.json"};
  // The camera is rotated and shifted relative to the body.
  WriteFile(folder / "sensor.yaml",
            "T_BS: {data: [0, -1, 0, 0.1, 1, 0, 0, -0.2, 0, 0, 1, 0.3, 0, 0, 0, 1]}\n");
  const std::vector<std::string> mounting = {"--extrinsics", folder / "sensor.yaml"};
  ASSERT_EQ(Convert(kTruth, folder / "body.csv", mounting).exit_code, 0);
  ASSERT_EQ(Convert(folder / "body.csv", folder / "euroc.tum", mounting).exit_code, 0);
  ASSERT_EQ(Convert(kTruth, folder / "model", lens).exit_code, 0);
  const RunResult run =
      Convert(folder / "model", folder / "colmap.tum", {"--frame-rate", "15", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["has_camera"], true);
  ASSERT_EQ(
      Convert(folder / "model", folder / "binary", {"--frame-rate", "15", "--to", "colmap-binary"})
          .exit_code,
      0);
  ASSERT_EQ(Convert(folder / "binary", folder / "binary.tum", {"--frame-rate", "15"}).exit_code, 0);
  const std::vector<TumPose> truth = ReadTum(kTruth);
  ASSERT_GT(truth.size(), 80U);
  for (const char* name : {"euroc.tum", "colmap.tum", "binary.tum"}) {
    const std::vector<TumPose> poses = ReadTum(folder / name);
    ASSERT_EQ(poses.size(), truth.size()) << name;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const PoseError error = ErrorOf(poses[i], truth[i]);
      EXPECT_LT(error.position_share, 1e-6) << name;
      EXPECT_LT(error.rotation_deg, 1e-4) << name;
      EXPECT_NEAR(poses[i].time_s, truth[i].time_s, 1e-5) << name;
    }
  }
  // The body's trajectory differs.
  EXPECT_NE(ReadFile(folder / "body.csv"), ReadFile(folder / "euroc.tum"));
  ASSERT_EQ(Convert(kTruth, folder / "path.mcap", lens).exit_code, 0);
  EXPECT_THAT(ReadFile(folder / "path.mcap"), StartsWith("\x89MCAP0\r\n"));
}

// As written by COLMAP's model_converter. If both forms exist the binary one is used, as in COLMAP.
TEST(Path, ReadsAModelInColmapsBinaryForm) {
  const TemporaryFolder folder;
  const std::filesystem::path example = tests::SourceTree() / "tests/export/trajectories/colmap";
  std::filesystem::create_directories(folder / "model");
  for (const char* name : {"cameras.bin", "images.bin", "points3D.bin"}) {
    std::filesystem::copy_file(example / name, folder / "model" / name);
  }
  WriteFile(folder / "model/images.txt", "nonsense\n");
  const RunResult run =
      Convert(folder / "model", folder / "path.tum", {"--frame-rate", "1", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out)["points"], 3);
  const std::vector<TumPose> poses = ReadTum(folder / "path.tum");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].time_s, 1180141.0);
  const std::string images = ReadFile(folder / "model/images.bin");
  WriteFile(folder / "model/images.bin", images.substr(0, images.size() / 2));
  const RunResult cut = Convert(folder / "model", folder / "cut.tum", {"--frame-rate", "1"});
  EXPECT_EQ(cut.exit_code, 2);
  EXPECT_THAT(cut.err, HasSubstr("images.bin, entry 2 of 2: ends before the entry does"));
  EXPECT_FALSE(std::filesystem::exists(folder / "cut.tum"));
}

// The camera that tools/blender/pleinair_path.py sets in Blender must project points like the real
// one. Blender's model: the window, one sensor width wide, lies `lens` in front of the camera and
// is shifted.
TEST(Path, IsSeenByBlendersCameraPixelByPixel) {
  const TemporaryFolder folder;
  WriteFile(folder / "lens.json", kLens);
  ASSERT_EQ(Convert(kTruth, folder / "camera.glb",
                    {"--calibration", folder / "lens.json", "--marker-size-mm", "480"})
                .exit_code,
            0);
  const RunResult run = RunCommandLine(
      {"python3", tests::SourceTree() / "tools/blender/pleinair_path.py", folder / "camera.glb"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto blender = nlohmann::json::parse(run.out);
  EXPECT_EQ(blender["frame_rate"], 15.0);
  const std::vector<TumPose> truth = ReadTum(kTruth);
  ASSERT_EQ(blender["keys"].size(), truth.size());
  const CameraModel lens{
      .width = 640, .height = 480, .fx = 585, .fy = 640, .cx = 300.3, .cy = 275.8};
  const double windows = blender["lens_mm"].get<double>() / 36.0;
  const double aspect_y = blender["pixel_aspect_y"];
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const auto& key = blender["keys"][i];
    EXPECT_NEAR(key["frame"], 1 + truth[i].time_s * 15, 1e-3);
    const auto& q = key["rotation_wxyz"];
    const Mat3 turn = RotationOf({.x = q[1], .y = q[2], .z = q[3], .w = q[0]});
    const Vec3 place{key["location"][0], key["location"][1], key["location"][2]};
    for (const auto& corner : blender["marker"]) {
      const Vec3 p{corner[0], corner[1], corner[2]};
      // Along Blender's axes: right, up, backward.
      const Vec3 seen = turn.Transposed() * (p - place);
      const double right = seen.x / -seen.z * windows - blender["shift_x"].get<double>();
      const double up = seen.y / -seen.z * windows - blender["shift_y"].get<double>();
      const Vec2 pixel{320 + right * 640 - 0.5, 240 - up * 640 / aspect_y - 0.5};
      const Vec2 expected =
          ProjectToPixel(lens, truth[i].marker_from_camera.Inverse() * Point<Marker>{p});
      EXPECT_LT(Norm(pixel - expected), 1e-3) << i;
    }
  }
  EXPECT_NEAR(std::abs(blender["marker"][0][0].get<double>()), 0.24, 1e-6);
}

class PathRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(PathRefusal, IsOneLineAndLeavesNothing) { ExpectRefusal("path", GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Convert, PathRefusal,
    testing::Values(
        Refusal{"NoForm",
                {"convert", kTruth, "OUT/x.doc"},
                "x.doc: has a name without a format that can be written"},
        Refusal{"NoLens", {"convert", kTruth, "OUT/x.glb"}, "x.glb: a glTF camera needs"},
        Refusal{"NoLensForColmap", {"convert", kTruth, "OUT/model"}, "--calibration"},
        Refusal{"NoTrajectory",
                {"convert", BundledRecording(), "OUT/x.tum"},
                "is a folder without a trajectory"},
        Refusal{"NoRate",
                {"convert", "--from", "colmap", BundledRecording(), "OUT/x.tum"},
                "--frame-rate"},
        Refusal{"Film",
                {"convert", BundledRecording() / "background.mp4", "OUT/x.tum"},
                "is a film, not a trajectory"},
        Refusal{"ReadOnly", {"convert", kTruth, "OUT/x.r3d"}, "which is only read"},
        Refusal{
            "NoModel",
            {"convert", "--from", "colmap", BundledRecording(), "OUT/x.tum", "--frame-rate", "30"},
            "cameras.txt: there is no such file"},
        Refusal{"NotRead",
                {"convert", "a.mcap", "OUT/x.tum"},
                "a.mcap: is an MCAP file, a format that can be written but not read"},
        Refusal{"NotThere", {"convert", "nowhere.tum", "OUT/x.csv"}, "nowhere.tum: "},
        Refusal{"Onto", {"convert", kTruth, kTruth}, "is the input itself"},
        Refusal{"NotTum",
                {"convert", "--from", "tum", BundledRecording() / "recording.json", "OUT/x.csv"},
                "recording.json:1: has 1 fields instead of 8"},
        Refusal{"ScaleIsNoNumber", {"convert", kTruth, "OUT/x.csv", "--scale", "nan"}, "--scale"}),
    [](const auto& refusal) { return std::string(refusal.param.name); });

}  // namespace
}  // namespace pleinair::e2e
