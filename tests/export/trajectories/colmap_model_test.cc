#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "export/trajectories/colmap_binary.h"
#include "export/trajectories/colmap_camera.h"
#include "export/trajectories/colmap_model.h"
#include "export/trajectories/colmap_text.h"
#include "tests/error_message.h"
#include "tests/source_tree.h"

namespace pleinair::exports {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// The example of COLMAP's documentation ("Output Format").
const ColmapFiles& ColmapExample() {
  static const ColmapFiles kTexts{
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

Result<CameraTrajectory> PathOf(Result<ColmapModel> model) {
  if (!model) return tl::make_unexpected(std::move(model).error());
  return TrajectoryFromColmap(*std::move(model), 30.0);
}
Result<CameraTrajectory> PathOfText(const ColmapFiles& files) {
  return PathOf(ParseColmapText(files, "model"));
}
Result<CameraTrajectory> PathOfBinary(const ColmapFiles& files) {
  return PathOf(ParseColmapBinary(files, "model"));
}

TEST(ColmapModel, ReadsTheDocumentationsOwnExample) {
  const auto path = PathOfText(ColmapExample());
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
  // COLMAP's pixel origin is the image's corner, ours the first pixel's centre.
  EXPECT_EQ(path->camera->cx, 1535.5);
  ASSERT_EQ(path->points.size(), 3U);
  EXPECT_EQ(path->points[1].place.xyz, (Vec3{2.01848, 0.108877, -0.0260841}));
  EXPECT_THAT(path->points[1].rgb, ElementsAre(102, 209, 250));
}

TEST(ColmapModel, WritesWhatItReads) {
  const auto path = PathOfText(ColmapExample());
  const auto model = ColmapFromTrajectory(*path);
  ASSERT_TRUE(model);
  EXPECT_THAT(ColmapText(*model).images,
              HasSubstr(" -0.737434 1.02973 3.74354 1 P1180141.JPG\n\n"));
  const auto again = PathOfText(ColmapText(*model));
  ASSERT_TRUE(again) << again.error().Message();
  EXPECT_EQ(again->points.size(), 3U);
  EXPECT_EQ(again->poses[1].picture, "P1180142.JPG");
  EXPECT_NEAR(again->poses[1].reference_from_camera.translation_m.x,
              path->poses[1].reference_from_camera.translation_m.x, 1e-9);
  EXPECT_FALSE(ColmapFromTrajectory(CameraTrajectory{}));
}

TEST(ColmapCamera, EveryKnownModelDistortsAsItsFormulaSays) {
  // Formulae of COLMAP's sensor/models.h at one image point.
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
    EXPECT_THAT(
        tests::MessageOf(CameraFromColmap({other, 640, 480, {500, 500, 320, 240, 0}}, "c:1")),
        HasSubstr(other));
  }
}

TEST(ColmapModel, RefusesWhatIsCutShortOrContradictsItself) {
  struct Case {
    std::string ColmapFiles::*file;
    const char *from, *to, *message;
  };
  for (const Case& c : {
           Case{&ColmapFiles::cameras, "1 SIMPLE_PINHOLE", "4 SIMPLE_PINHOLE", "the model has not"},
           Case{&ColmapFiles::cameras, "2559.81 1536", "2559.81", "cameras.txt:4: "},
           Case{&ColmapFiles::cameras, "2559.81 1536", "-2559.81 1536", "focal length"},
           Case{&ColmapFiles::cameras, "2 PINHOLE", "1 PINHOLE", "another camera"},
           Case{&ColmapFiles::cameras, "3072 2304 2559.81", "99999999999 2304 2559.81", "image of"},
           Case{&ColmapFiles::images, "1 0.851773", "1 0.51773", "images.txt:5: has a quaternion"},
           Case{&ColmapFiles::images, "-0.737434", "nan", "images.txt:5: "},
           Case{&ColmapFiles::images, " 1 P1180141.JPG", " 1", "names no image"},
           Case{&ColmapFiles::images, " 268.254 -1\n", " 268.254\n", "images.txt:6: "},
           Case{&ColmapFiles::images, "P1180142", "P1180141", "number or name of another"},
           Case{&ColmapFiles::images, "3.74354 1 P1180142", "3.74354 2 P1180142", "another camera"},
           Case{&ColmapFiles::images, "images: 2", "images: 3", "promises 3 entries and has 2"},
           Case{&ColmapFiles::points3d, "245 251 249", "245 256 249", "points3D.txt:6: "},
           Case{&ColmapFiles::points3d, " 117 4473", " 117", "ends in its middle"},
           Case{&ColmapFiles::points3d, "1.67241", "inf", "points3D.txt:4: "},
       }) {
    ColmapFiles texts = ColmapExample();
    std::string& text = texts.*c.file;
    const std::size_t at = text.find(c.from);
    ASSERT_NE(at, std::string::npos) << c.from;
    text.replace(at, std::string(c.from).size(), c.to);
    EXPECT_THAT(tests::MessageOf(PathOfText(texts)), HasSubstr(c.message)) << c.from;
  }
  EXPECT_THAT(tests::MessageOf(PathOfText({})), HasSubstr("holds no images"));
}

// The same example as written by COLMAP 3.8's model_converter.
ColmapFiles BinaryExample() {
  const auto bytes = [](const char* name) {
    std::ifstream file(tests::SourceTree() / "tests/export/trajectories/colmap" / name,
                       std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  return {bytes("cameras.bin"), bytes("images.bin"), bytes("points3D.bin")};
}

void ExpectSamePath(const CameraTrajectory& a, const CameraTrajectory& b) {
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_EQ(a.poses[i].picture, b.poses[i].picture);
    EXPECT_EQ(a.poses[i].timestamp_ns, b.poses[i].timestamp_ns);
    const auto &p = a.poses[i].reference_from_camera, &q = b.poses[i].reference_from_camera;
    EXPECT_LT(Norm(p.translation_m - q.translation_m), 1e-12);
    for (int k = 0; k < 9; ++k) EXPECT_NEAR(p.rotation.m[k], q.rotation.m[k], 1e-12);
  }
  ASSERT_TRUE(a.camera && b.camera);
  EXPECT_EQ(a.camera->width, b.camera->width);
  EXPECT_EQ(a.camera->fx, b.camera->fx);
  EXPECT_EQ(a.camera->cy, b.camera->cy);
  EXPECT_EQ(a.camera->distortion, b.camera->distortion);
  ASSERT_EQ(a.points.size(), b.points.size());
}

TEST(ColmapBinary, ReportsWhatTheTextTells) {
  const auto binary = PathOfBinary(BinaryExample()), text = PathOfText(ColmapExample());
  ASSERT_TRUE(binary) << binary.error().Message();
  ExpectSamePath(*binary, *text);
  // COLMAP writes points in its own order.
  for (const TrajectoryPoint& point : text->points) {
    EXPECT_TRUE(std::any_of(binary->points.begin(), binary->points.end(),
                            [&](const TrajectoryPoint& p) {
                              return p.place.xyz == point.place.xyz && p.rgb == point.rgb &&
                                     p.error_px == point.error_px;
                            }))
        << point.error_px;
  }
}

TEST(ColmapBinary, WritesWhatItReads) {
  auto path = *PathOfBinary(BinaryExample());
  path.camera->distortion = {0.1, 0.2, 0.3, 0.4, 0.5};
  const ColmapFiles files = ColmapBinary(*ColmapFromTrajectory(path));
  const auto again = PathOfBinary(files);
  ASSERT_TRUE(again) << again.error().Message();
  ExpectSamePath(*again, path);
  EXPECT_EQ(again->points[2].place.xyz, path.points[2].place.xyz);
  EXPECT_EQ(again->points[2].rgb, path.points[2].rgb);
  // Sizes from the format's description: FULL_OPENCV has twelve parameters.
  EXPECT_EQ(files.cameras.size(), 8U + 24 + 12 * 8);
  EXPECT_EQ(files.images.size(), 8U + 2 * (4 + 7 * 8 + 4 + 13 + 8));
  EXPECT_EQ(files.points3d.size(), 8U + 3 * (8 + 3 * 8 + 3 + 8 + 8));
}

TEST(ColmapBinary, CutAtAnyByteIsAnErrorThatNamesTheFile) {
  const std::pair<std::string ColmapFiles::*, const char*> kFiles[] = {
      {&ColmapFiles::cameras, "model/cameras.bin"},
      {&ColmapFiles::images, "model/images.bin"},
      {&ColmapFiles::points3d, "model/points3D.bin"}};
  for (const auto& [file, name] : kFiles) {
    const std::string whole = BinaryExample().*file;
    ASSERT_GT(whole.size(), 100U);
    // An empty points file is valid: a model may have no points.
    for (std::size_t size = file == &ColmapFiles::points3d ? 1 : 0; size < whole.size(); ++size) {
      ColmapFiles files = BinaryExample();
      files.*file = whole.substr(0, size);
      const auto path = PathOfBinary(files);
      EXPECT_THAT(tests::MessageOf(path), StartsWith(name)) << size;
    }
    ColmapFiles files = BinaryExample();
    (files.*file) += '\0';
    EXPECT_THAT(tests::MessageOf(PathOfBinary(files)),
                AllOf(StartsWith(name), HasSubstr("1 bytes behind the")));
  }
}

TEST(ColmapBinary, RefusesWhatIsNoModel) {
  struct Case {
    std::string ColmapFiles::*file;
    std::size_t at;
    std::string bytes;
    const char* message;
  };
  const std::string most(8, '\xFF'), nan("\0\0\0\0\0\0\xF8\x7F", 8);
  const auto cameras = &ColmapFiles::cameras;
  const auto images = &ColmapFiles::images;
  const auto points = &ColmapFiles::points3d;
  for (const Case& c : {
           Case{cameras, 0, most, "cameras.bin, entry 4 of 18446744073709551615: ends before"},
           Case{cameras, 12, "\x0A", "\"THIN_PRISM_FISHEYE\", which is not supported"},
           Case{cameras, 12, "\x63", "\"number 99\", which is not supported"},
           Case{cameras, 16, std::string(8, '\0'), "entry 1 of 3: has an image of 0x2304"},
           Case{cameras, 32, nan, "cameras.bin, entry 1 of 3: has a parameter that is not finite"},
           Case{cameras, 64, "\x03", "entry 2 of 3: has the number of another camera"},
           Case{images, 12, nan, "images.bin, entry 1 of 2: has a quaternion"},
           Case{images, 44, nan, "images.bin, entry 1 of 2: has a position beyond"},
           Case{images, 68, "\x07", "another camera"},
           Case{images, 72, std::string(1, '\0'), "images.bin, entry"},
           Case{images, 73, "\n", "entry 1 of 2: has an image's name that is empty or not print"},
           Case{images, 85, most, "images.bin, entry 1 of 2: ends before"},
           Case{points, 16, nan, "points3D.bin, entry 1 of 3: has a position"},
           Case{points, 43, nan, "points3D.bin, entry 1 of 3: has an error that is not finite"},
           Case{points, 51, most, "points3D.bin, entry 1 of 3: ends before"},
       }) {
    ColmapFiles files = BinaryExample();
    (files.*c.file).replace(c.at, c.bytes.size(), c.bytes);
    EXPECT_THAT(tests::MessageOf(PathOfBinary(files)), HasSubstr(c.message));
  }
  const std::string none(8, '\0');
  EXPECT_THAT(tests::MessageOf(PathOfBinary({none, none, none})),
              "model/images.bin: holds no images; "
              "get a whole copy of it");
}

}  // namespace
}  // namespace pleinair::exports
