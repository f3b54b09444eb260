#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "app/output/observed_trajectory.h"
#include "export/trajectories/euroc_trajectory.h"
#include "export/trajectories/text_lines.h"
#include "export/trajectories/tum_trajectory.h"
#include "tests/error_message.h"

namespace pleinair::exports {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Mat3 About(Vec3 axis, double angle) {
  const Vec3 a = Normalized(axis) * std::sin(angle / 2);
  return RotationOf({a.x, a.y, a.z, std::cos(angle / 2)});
}

CameraTrajectory OnePose(const Transform<Reference, Camera>& pose) {
  CameraTrajectory path;
  path.poses.push_back({1'066'667'000, pose, ""});
  return path;
}

// Ground truth of freiburg1_xyz, as published by the TUM RGB-D benchmark.
constexpr const char* kTumExample =
    "# ground truth trajectory\n"
    "# file: 'rgbd_dataset_freiburg1_xyz.bag'\n"
    "# timestamp tx ty tz qx qy qz qw\n"
    "1305031098.6659 1.3563 0.6305 1.6380 0.6132 0.5962 -0.3311 -0.3986\n"
    "1305031098.6758 1.3543 0.6306 1.6360 0.6129 0.5966 -0.3316 -0.3980\n";

TEST(TumPath, ReadsTheBenchmarksOwnExample) {
  const auto path = ParseTum(kTumExample, "groundtruth.txt");
  ASSERT_TRUE(path) << path.error().Message();
  ASSERT_EQ(path->poses.size(), 2U);
  EXPECT_EQ(path->poses[0].timestamp_ns, 1'305'031'098'665'900'000);
  EXPECT_EQ(path->poses[1].timestamp_ns, 1'305'031'098'675'800'000);
  const auto& pose = path->poses[0].reference_from_camera;
  EXPECT_EQ(pose.translation_m, (Vec3{1.3563, 0.6305, 1.6380}));
  // The desk in that sequence is below the camera, which looks down.
  EXPECT_LT((pose * Direction<Camera>{{0, 0, 1}}).xyz.z, -0.4);
}

TEST(TumPath, WritesWhatItReads) {
  const auto path = ParseTum(kTumExample, "in");
  const auto again = ParseTum(TumText(*path, "camera"), "out");
  ASSERT_TRUE(again);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again->poses[i].timestamp_ns, path->poses[i].timestamp_ns);
    for (int k = 0; k < 9; ++k) {
      EXPECT_NEAR(again->poses[i].reference_from_camera.rotation.m[k],
                  path->poses[i].reference_from_camera.rotation.m[k], 1e-8);
    }
  }
}

TEST(TumPath, ReportsTheCameraInTheMarkersFrame) {
  session::Observation seen;
  seen.timestamp_ns = 1'066'667'000;
  seen.camera_from_marker =
      Transform<Marker, Camera>{About({0, 0, 1}, std::numbers::pi / 2), {1, 2, 3}}.Inverse();
  EXPECT_THAT(TumText(app::ObservedTrajectory({seen}), "comment"),
              HasSubstr("\n1.066667 1.000000000 2.000000000 3.000000000 0.000000000 0.000000000 "
                        "0.707106781 0.707106781\n"));
}

TEST(TumPath, GivesTheQuaternionOfEveryAxisAndAngle) {
  for (const Vec3 axis : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, -2, 0.5}, {-1, -1, 3}}) {
    for (const double angle : {1e-5, 0.5, 1.6, 3.0, std::numbers::pi - 1e-4, 4.0, 6.0}) {
      const auto path = ParseTum(TumText(OnePose({About(axis, angle), {}}), "c"), "file");
      ASSERT_TRUE(path) << path.error().Message();
      for (int k = 0; k < 9; ++k) {
        EXPECT_NEAR(path->poses[0].reference_from_camera.rotation.m[k], About(axis, angle).m[k],
                    1e-8)
            << angle;
      }
    }
  }
}

TEST(PathTimes, AreReadToTheNanosecond) {
  EXPECT_EQ(NanosecondsFromSeconds("1403636580.838555648", "f"), 1'403'636'580'838'555'648);
  EXPECT_EQ(NanosecondsFromSeconds("-0.5", "f"), -500'000'000);
  EXPECT_EQ(NanosecondsFromSeconds("1.4036365e+09", "f"), 1'403'636'500'000'000'000);
  EXPECT_EQ(SecondsText(1'403'636'580'838'555'648), "1403636580.838555648");
  EXPECT_EQ(SecondsText(-500'000'000), "-0.500000");
  for (const char* wrong : {"", "-", "nan", "1e300", "1.2.3", "12a"}) {
    EXPECT_FALSE(NanosecondsFromSeconds(wrong, "f")) << wrong;
  }
}

TEST(TumPath, RefusesWhatIsNoPathWithItsLine) {
  const std::string good = "1.5 0 0 0 0 0 0 1\n";
  EXPECT_THAT(tests::MessageOf(ParseTum("", "f.tum")), HasSubstr("holds no poses"));
  EXPECT_THAT(tests::MessageOf(ParseTum("# only a comment", "f.tum")), HasSubstr("holds no poses"));
  for (const char* wrong :
       {"2 0 0 0 0 0 0", "2 0 0 0 0 0 0 1 1", "2 nan 0 0 0 0 0 1", "2 inf 0 0 0 0 0 1",
        "2 0 0 0 0 0 0 0", "2 0 0 0 0 0 0 0.8", "2 0 0 0 0 0 0 nan", "2 1e10 0 0 0 0 0 1",
        "x 0 0 0 0 0 0 1", "nan 0 0 0 0 0 0 1", "1.5 0 0 0 0 0 0 1", "1.4 0 0 0 0 0 0 1"}) {
    const auto path = ParseTum(good + wrong + "\n3 0 0 0 0 0 0 1\n", "f.tum");
    EXPECT_THAT(tests::MessageOf(path), StartsWith("f.tum:2: ")) << wrong;
    EXPECT_EQ(path.error().kind, ErrorKind::kInput);
  }
}

// The first line of MH_01_easy's ground truth and its cam0's T_BS, as published with the data set.
constexpr const char* kEurocExample =
    "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
    "q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], "
    "b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], "
    "b_a_RS_S_z [m s^-2]\n"
    "1403636580838555648,4.688319,-1.786938,0.783338,0.534108,-0.153029,-0.827383,-0.082152,"
    "-0.027876,0.033207,0.800006,-0.003172,0.021267,0.078502,-0.025266,0.136696,0.075593\n";
constexpr const char* kEurocSensor =
    "sensor_type: camera\n"
    "T_BS:\n  cols: 4\n  rows: 4\n"
    "  data: [0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975,\n"
    "         0.999557249008, 0.0149672133247, 0.025715529948, -0.064676986768,\n"
    "        -0.0257744366974, 0.00375618835797, 0.999660727178, 0.00981073058949,\n"
    "         0.0, 0.0, 0.0, 1.0]\n";

TEST(EurocPath, ReadsTheBodysPathAndTheCamerasThroughItsMounting) {
  const auto body = ParseEurocTrajectory(kEurocExample, "data.csv");
  ASSERT_TRUE(body) << body.error().Message();
  EXPECT_EQ(body->poses[0].timestamp_ns, 1'403'636'580'838'555'648);
  EXPECT_EQ(body->poses[0].reference_from_camera.translation_m,
            (Vec3{4.688319, -1.786938, 0.783338}));
  const auto mounting = devices::ParseEurocExtrinsics(kEurocSensor, "sensor.yaml");
  ASSERT_TRUE(mounting) << mounting.error().Message();
  const auto camera = ParseEurocTrajectory(kEurocExample, "data.csv", *mounting);
  // Computed with matrices in NumPy.
  const auto& pose = camera->poses[0].reference_from_camera;
  EXPECT_NEAR(pose.translation_m.x, 4.66612097, 1e-6);
  EXPECT_NEAR(pose.translation_m.y, -1.84835617, 1e-6);
  EXPECT_NEAR(pose.translation_m.z, 0.761367244, 1e-6);
  EXPECT_NEAR(pose.rotation(0, 2), -0.851204070, 1e-5);
  EXPECT_NEAR(pose.rotation(2, 1), -0.910832474, 1e-5);
  const std::string text = EurocTrajectoryText(*camera, *mounting);
  EXPECT_THAT(text, AllOf(StartsWith("#timestamp [ns],p_RS_R_x [m],"),
                          HasSubstr("\n1403636580838555648,4.688319000,-1.786938000,0.783338000,"
                                    "0.534")));
}

TEST(EurocPath, RefusesWhatIsNoPathOrMounting) {
  for (const char* wrong :
       {"12,0,0,0,1,0,0", "12.5,0,0,0,1,0,0,0", "12,0,0,0,0,0,0,0", "12,0,0,nan,1,0,0,0",
        "9223372036854775807,0,0,0,1,0,0,0", "10,0,0,0,1,0,0,0", "12,cam0.png"}) {
    const auto path =
        ParseEurocTrajectory("10,0,0,0,1,0,0,0\n" + std::string(wrong) + "\n", "f.csv");
    EXPECT_THAT(tests::MessageOf(path), StartsWith("f.csv:2: ")) << wrong;
  }
  for (const char* wrong :
       {"rate_hz: 20\n", "T_BS: {data: [1, 2, 3]}\n",
        "T_BS: {data: [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}\n",
        "T_BS: {data: [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}\n",
        "T_BS: {data: [1, 0, 0, .nan, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}\n"}) {
    EXPECT_FALSE(devices::ParseEurocExtrinsics(wrong, "sensor.yaml")) << wrong;
  }
}

}  // namespace
}  // namespace pleinair::exports
