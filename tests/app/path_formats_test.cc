#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "app/paths/colmap_camera.h"
#include "app/paths/colmap_model.h"
#include "app/paths/euroc_path.h"
#include "app/paths/observed_path.h"
#include "app/paths/text_lines.h"
#include "app/paths/tum_path.h"

namespace pleinair::app {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Mat3 About(Vec3 axis, double angle) {
  const Vec3 a = Normalized(axis) * std::sin(angle / 2);
  return RotationOf({a.x, a.y, a.z, std::cos(angle / 2)});
}

CameraPath OnePose(const Transform<Reference, Camera>& pose) {
  CameraPath path;
  path.poses.push_back({1'066'667'000, pose, ""});
  return path;
}

template <typename T>
std::string MessageOf(const Result<T>& result) {
  return result ? "no error" : result.error().Message();
}

// Ground truth of freiburg1_xyz, as the TUM RGB-D benchmark publishes it.
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
  EXPECT_EQ(TrajectoryOf(*path)[0].marker_from_camera.translation_m, pose.translation_m);
  // The desk of that sequence lies below the camera: it looks down.
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

TEST(TumPath, TellsTheCameraInTheMarkersFrame) {
  Observation seen;
  seen.timestamp_ns = 1'066'667'000;
  seen.camera_from_marker =
      Transform<Marker, Camera>{About({0, 0, 1}, std::numbers::pi / 2), {1, 2, 3}}.Inverse();
  EXPECT_THAT(TumText(ObservedPath({seen}), "comment"),
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
  EXPECT_THAT(MessageOf(ParseTum("", "f.tum")), HasSubstr("holds no poses"));
  EXPECT_THAT(MessageOf(ParseTum("# only a comment", "f.tum")), HasSubstr("holds no poses"));
  for (const char* wrong :
       {"2 0 0 0 0 0 0", "2 0 0 0 0 0 0 1 1", "2 nan 0 0 0 0 0 1", "2 inf 0 0 0 0 0 1",
        "2 0 0 0 0 0 0 0", "2 0 0 0 0 0 0 0.8", "2 0 0 0 0 0 0 nan", "2 1e10 0 0 0 0 0 1",
        "x 0 0 0 0 0 0 1", "nan 0 0 0 0 0 0 1", "1.5 0 0 0 0 0 0 1", "1.4 0 0 0 0 0 0 1"}) {
    const auto path = ParseTum(good + wrong + "\n3 0 0 0 0 0 0 1\n", "f.tum");
    EXPECT_THAT(MessageOf(path), StartsWith("f.tum:2: ")) << wrong;
    EXPECT_EQ(path.error().kind, ErrorKind::kInput);
  }
}

// The first line of MH_01_easy's ground truth and its cam0's T_BS, as the data set publishes them.
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
  const auto body = ParseEurocPath(kEurocExample, "data.csv");
  ASSERT_TRUE(body) << body.error().Message();
  EXPECT_EQ(body->poses[0].timestamp_ns, 1'403'636'580'838'555'648);
  EXPECT_EQ(body->poses[0].reference_from_camera.translation_m,
            (Vec3{4.688319, -1.786938, 0.783338}));
  const auto mounting = devices::ParseEurocExtrinsics(kEurocSensor, "sensor.yaml");
  ASSERT_TRUE(mounting) << mounting.error().Message();
  const auto camera = ParseEurocPath(kEurocExample, "data.csv", *mounting);
  // By matrices of another program (NumPy).
  const auto& pose = camera->poses[0].reference_from_camera;
  EXPECT_NEAR(pose.translation_m.x, 4.66612097, 1e-6);
  EXPECT_NEAR(pose.translation_m.y, -1.84835617, 1e-6);
  EXPECT_NEAR(pose.translation_m.z, 0.761367244, 1e-6);
  EXPECT_NEAR(pose.rotation(0, 2), -0.851204070, 1e-5);
  EXPECT_NEAR(pose.rotation(2, 1), -0.910832474, 1e-5);
  const std::string text = EurocPathText(*camera, *mounting);
  EXPECT_THAT(text, AllOf(StartsWith("#timestamp [ns],p_RS_R_x [m],"),
                          HasSubstr("\n1403636580838555648,4.688319000,-1.786938000,0.783338000,"
                                    "0.534")));
}

TEST(EurocPath, RefusesWhatIsNoPathOrMounting) {
  for (const char* wrong :
       {"12,0,0,0,1,0,0", "12.5,0,0,0,1,0,0,0", "12,0,0,0,0,0,0,0", "12,0,0,nan,1,0,0,0",
        "9223372036854775807,0,0,0,1,0,0,0", "10,0,0,0,1,0,0,0", "12,cam0.png"}) {
    const auto path = ParseEurocPath("10,0,0,0,1,0,0,0\n" + std::string(wrong) + "\n", "f.csv");
    EXPECT_THAT(MessageOf(path), StartsWith("f.csv:2: ")) << wrong;
  }
  for (const char* wrong :
       {"rate_hz: 20\n", "T_BS: {data: [1, 2, 3]}\n",
        "T_BS: {data: [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}\n",
        "T_BS: {data: [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}\n",
        "T_BS: {data: [1, 0, 0, .nan, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}\n"}) {
    EXPECT_FALSE(devices::ParseEurocExtrinsics(wrong, "sensor.yaml")) << wrong;
  }
}

// The example of COLMAP's documentation ("Output Format").
const ColmapTexts& ColmapExample() {
  static const ColmapTexts kTexts{
      "# Camera list with one line of data per camera:\n"
      "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
      "# Number of cameras: 3\n"
      "1 SIMPLE_PINHOLE 3072 2304 2559.81 1536 1152\n"
      "2 PINHOLE 3072 2304 2560.56 2560.56 1536 1152\n"
      "3 SIMPLE_RADIAL 3072 2304 2559.69 1536 1152 -0.0218531\n",
      "# Image list with two lines of data per image:\n"
      "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
      "#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
      "# Number of images: 2, mean observations per image: 2\n"
      "1 0.851773 0.0165051 0.503764 -0.142941 -0.737434 1.02973 3.74354 1 P1180141.JPG\n"
      "2362.39 248.498 58396 1784.7 268.254 59027 1784.7 268.254 -1\n"
      "2 0.851773 0.0165051 0.503764 -0.142941 -0.737434 1.02973 3.74354 1 P1180142.JPG\n"
      "1190.83 663.957 23056 1258.77 640.354 59070\n",
      "# 3D point list with one line of data per point:\n"
      "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"
      "# Number of points: 3, mean track length: 3.3334\n"
      "63390 1.67241 0.292931 0.609726 115 121 122 1.33927 16 6542 15 7345 6 6714 14 7227\n"
      "63376 2.01848 0.108877 -0.0260841 102 209 250 1.73449 16 6519 15 7322 14 7212 8 3991\n"
      "63371 1.71102 0.28566 0.53475 245 251 249 0.612829 118 4140 117 4473\n"};
  return kTexts;
}

TEST(ColmapModel, ReadsTheDocumentationsOwnExample) {
  const auto path = ParseColmap(ColmapExample(), "model", 30.0);
  ASSERT_TRUE(path) << path.error().Message();
  ASSERT_EQ(path->poses.size(), 2U);
  EXPECT_EQ(path->poses[0].picture, "P1180141.JPG");
  EXPECT_NEAR(path->poses[1].timestamp_ns - path->poses[0].timestamp_ns, 33'333'333, 1);
  // "The coordinates of the projection/camera center are given by -R^t * T".
  const Mat3 r = RotationOf({.x = 0.0165051, .y = 0.503764, .z = -0.142941, .w = 0.851773});
  const Vec3 centre = -(r.Transposed() * Vec3{-0.737434, 1.02973, 3.74354});
  EXPECT_EQ(path->poses[0].reference_from_camera.translation_m, centre);
  ASSERT_TRUE(path->camera);
  EXPECT_EQ(path->camera->fx, 2559.81);
  EXPECT_EQ(path->camera->fy, 2559.81);
  // COLMAP's pixels begin at the picture's corner, ours at the first pixel's centre.
  EXPECT_EQ(path->camera->cx, 1535.5);
  ASSERT_EQ(path->points.size(), 3U);
  EXPECT_EQ(path->points[1].place.xyz, (Vec3{2.01848, 0.108877, -0.0260841}));
  EXPECT_THAT(path->points[1].rgb, ElementsAre(102, 209, 250));
}

TEST(ColmapModel, WritesWhatItReads) {
  const auto path = ParseColmap(ColmapExample(), "model", 30.0);
  const auto texts = ColmapFromPath(*path);
  ASSERT_TRUE(texts);
  EXPECT_THAT(texts->images, HasSubstr(" -0.737434 1.02973 3.74354 1 P1180141.JPG\n\n"));
  const auto again = ParseColmap(*texts, "again", 30.0);
  ASSERT_TRUE(again) << again.error().Message();
  EXPECT_EQ(again->points.size(), 3U);
  EXPECT_EQ(again->poses[1].picture, "P1180142.JPG");
  EXPECT_NEAR(again->poses[1].reference_from_camera.translation_m.x,
              path->poses[1].reference_from_camera.translation_m.x, 1e-9);
  EXPECT_FALSE(ColmapFromPath(OnePose({})));
}

TEST(ColmapCamera, EveryKnownModelDistortsAsItsFormulaSays) {
  // Formulae of COLMAP's sensor/models.h at one point of the picture.
  const double u = 0.3, v = -0.2, r2 = u * u + v * v;
  const double theta = std::atan(std::sqrt(r2)), t2 = theta * theta;
  struct Case {
    ColmapCamera camera;
    double x, y;
  };
  const double k1 = -0.1, k2 = 0.05, p1 = 0.01, p2 = -0.02;
  const double radial = 1 + k1 * r2 + k2 * r2 * r2;
  const double fish = theta / std::sqrt(r2) * (1 + k1 * t2 + k2 * t2 * t2);
  const double rational =
      (radial + 0.2 * r2 * r2 * r2) / (1 + 0.3 * r2 + 0.1 * r2 * r2 - 0.2 * r2 * r2 * r2);
  const double tx = 2 * p1 * u * v + p2 * (r2 + 2 * u * u);
  const double ty = 2 * p2 * u * v + p1 * (r2 + 2 * v * v);
  for (const Case& c : {
           Case{{"SIMPLE_PINHOLE", 640, 480, {500, 320, 240}}, u, v},
           Case{{"PINHOLE", 640, 480, {500, 500, 320, 240}}, u, v},
           Case{{"SIMPLE_RADIAL", 640, 480, {500, 320, 240, k1}},
                u * (1 + k1 * r2),
                v * (1 + k1 * r2)},
           Case{{"RADIAL", 640, 480, {500, 320, 240, k1, k2}}, u * radial, v * radial},
           Case{{"OPENCV", 640, 480, {500, 500, 320, 240, k1, k2, p1, p2}},
                u * radial + tx,
                v * radial + ty},
           Case{
               {"FULL_OPENCV", 640, 480, {500, 500, 320, 240, k1, k2, p1, p2, 0.2, 0.3, 0.1, -0.2}},
               u * rational + tx,
               v * rational + ty},
           Case{{"SIMPLE_RADIAL_FISHEYE", 640, 480, {500, 320, 240, k1}},
                u * theta / std::sqrt(r2) * (1 + k1 * t2),
                v * theta / std::sqrt(r2) * (1 + k1 * t2)},
           Case{{"RADIAL_FISHEYE", 640, 480, {500, 320, 240, k1, k2}}, u * fish, v * fish},
           Case{{"OPENCV_FISHEYE", 640, 480, {500, 500, 320, 240, k1, k2, 0, 0}},
                u * fish,
                v * fish},
       }) {
    const auto ours = CameraFromColmap(c.camera, "cameras.txt:4");
    ASSERT_TRUE(ours) << ours.error().Message();
    const Vec2 pixel = ProjectToPixel(*ours, Point<Camera>{{u * 3, v * 3, 3}});
    EXPECT_NEAR(pixel.x + 0.5, 500 * c.x + 320, 1e-9) << c.camera.model;
    EXPECT_NEAR(pixel.y + 0.5, 500 * c.y + 240, 1e-9) << c.camera.model;
    const auto back = CameraFromColmap(ColmapFromCamera(*ours), "again");
    ASSERT_TRUE(back);
    EXPECT_EQ(back->distortion, ours->distortion) << c.camera.model;
    EXPECT_EQ(back->cx, ours->cx);
  }
  for (const char* other :
       {"FOV", "THIN_PRISM_FISHEYE", "RAD_TAN_THIN_PRISM_FISHEYE", "nonsense"}) {
    EXPECT_THAT(MessageOf(CameraFromColmap({other, 640, 480, {500, 500, 320, 240, 0}}, "c:1")),
                HasSubstr(other));
  }
}

TEST(ColmapModel, RefusesWhatIsCutShortOrContradictsItself) {
  struct Case {
    std::string ColmapTexts::*file;
    const char *from, *to, *message;
  };
  for (const Case& c : {
           Case{&ColmapTexts::cameras, "1 SIMPLE_PINHOLE", "4 SIMPLE_PINHOLE",
                "cameras.txt has not"},
           Case{&ColmapTexts::cameras, "2559.81 1536", "2559.81", "cameras.txt:4: "},
           Case{&ColmapTexts::cameras, "2559.81 1536", "-2559.81 1536", "focal length"},
           Case{&ColmapTexts::cameras, "2 PINHOLE", "1 PINHOLE", "another camera"},
           Case{&ColmapTexts::cameras, "3072 2304 2559.81", "99999999999 2304 2559.81",
                "picture of"},
           Case{&ColmapTexts::images, "1 0.851773", "1 0.51773", "images.txt:5: has a quaternion"},
           Case{&ColmapTexts::images, "-0.737434", "nan", "images.txt:5: "},
           Case{&ColmapTexts::images, " 1 P1180141.JPG", " 1", "names no picture"},
           Case{&ColmapTexts::images, " 268.254 -1\n", " 268.254\n", "images.txt:6: "},
           Case{&ColmapTexts::images, "P1180142", "P1180141", "number or name of another"},
           Case{&ColmapTexts::images, "3.74354 1 P1180142", "3.74354 2 P1180142", "another camera"},
           Case{&ColmapTexts::images, "images: 2", "images: 3", "promises 3 entries and has 2"},
           Case{&ColmapTexts::points3d, "245 251 249", "245 256 249", "points3D.txt:6: "},
           Case{&ColmapTexts::points3d, " 117 4473", " 117", "ends in its middle"},
           Case{&ColmapTexts::points3d, "1.67241", "inf", "points3D.txt:4: "},
       }) {
    ColmapTexts texts = ColmapExample();
    std::string& text = texts.*c.file;
    const std::size_t at = text.find(c.from);
    ASSERT_NE(at, std::string::npos) << c.from;
    text.replace(at, std::string(c.from).size(), c.to);
    EXPECT_THAT(MessageOf(ParseColmap(texts, "model", 30.0)), HasSubstr(c.message)) << c.from;
  }
  EXPECT_THAT(MessageOf(ParseColmap({"", "", ""}, "model", 30.0)), HasSubstr("holds no pictures"));
}

}  // namespace
}  // namespace pleinair::app
