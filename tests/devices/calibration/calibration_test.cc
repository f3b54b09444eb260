#include "devices/calibration/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "devices/calibration/calibration_text.h"
#include "tests/temporary_folder.h"

namespace pleinair::devices {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kOwn = R"({"image_width": 640, "image_height": 480, "model": "opencv-radtan",
  "fx": 585, "fy": 588.5, "cx": 326.3, "cy": 235.8,
  "distortion_k1_k2_p1_p2_k3": [-0.13, 0.045, 0.0006, -0.0004, 0.01]})";

// As written by cv::FileStorage of OpenCV 4.6, with the names of its calibration sample.
constexpr const char* kOpenCv = R"(%YAML:1.0
---
calibration_time: "Sun Sep 14 11:05:00 2025"
image_width: 640
image_height: 480
flags: 0
fisheye_model: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.8500000000000000e+02, 0., 3.2630000000000001e+02, 0.,
       5.8850000000000000e+02, 2.3580000000000001e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -1.3000000000000000e-01, 4.4999999999999998e-02,
       5.9999999999999995e-04, -4.0000000000000002e-04, 1.0000000000000000e-02 ]
avg_reprojection_error: 2.1e-01
)";

// As written by ROS's camera_calibration.
constexpr const char* kRos = R"(image_width: 640
image_height: 480
camera_name: head_camera
camera_matrix:
  rows: 3
  cols: 3
  data: [585, 0, 326.3, 0, 588.5, 235.8, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.13, 0.045, 0.0006, -0.0004, 0.01]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
projection_matrix:
  rows: 3
  cols: 4
  data: [585, 0, 326.3, 0, 0, 588.5, 235.8, 0, 0, 0, 1, 0]
)";

constexpr const char* kKalibr = R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.13, 0.045, 0.0006, -0.0004]
  distortion_model: radtan
  intrinsics: [585.0, 588.5, 326.3, 235.8]
  resolution: [640, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, 0.1]
  camera_model: omni
)";

// EuRoC MAV dataset, cam0/sensor.yaml, abridged.
constexpr const char* kEuroc = R"(# General sensor definitions.
sensor_type: camera
comment: VI-Sensor cam0 (MT9M034)
T_BS:
  cols: 4
  rows: 4
  data: [0.0148655429818, -0.999880929698, 0.00414029679422, -0.0216401454975]
rate_hz: 20
resolution: [752, 480]
camera_model: pinhole
intrinsics: [458.654, 457.296, 367.215, 248.375] #fu, fv, cu, cv
distortion_model: radial-tangential
distortion_coefficients: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
)";

void ExpectTheLens(const Result<CameraModel>& camera, double k3) {
  ASSERT_TRUE(camera) << camera.error().Message();
  EXPECT_EQ(camera->width, 640);
  EXPECT_EQ(camera->height, 480);
  EXPECT_EQ(camera->fx, 585);
  EXPECT_EQ(camera->fy, 588.5);
  EXPECT_EQ(camera->cx, 326.3);
  EXPECT_EQ(camera->cy, 235.8);
  EXPECT_EQ(camera->distortion_model, DistortionModel::kBrownConrady);
  EXPECT_THAT(camera->distortion, ElementsAre(-0.13, 0.045, 0.0006, -0.0004, k3, 0, 0, 0));
}

std::string Refusal(std::string_view bytes) {
  return tests::MessageOf(ParseCalibration(bytes, "lens.yaml"));
}

TEST(Calibration, SameLensComesOutOfEveryForm) {
  ExpectTheLens(ParseCalibration(kOwn, "own"), 0.01);
  ExpectTheLens(ParseCalibration(std::string(R"({"calibration": )") + kOwn + "}", "recording"),
                0.01);
  ExpectTheLens(ParseCalibration(kOpenCv, "opencv"), 0.01);
  ExpectTheLens(ParseCalibration(kRos, "ros"), 0.01);
  ExpectTheLens(ParseCalibration(kKalibr, "kalibr"), 0.0);
  ExpectTheLens(ParseCalibration(R"({"image": {"width": 640, "height": 480},
    "intrinsics": {"model": "opencv_k1k2p1p2k3", "fx": 585, "fy": 588.5, "cx": 326.3, "cy": 235.8,
    "dist": [-0.13, 0.045, 0.0006, -0.0004, 0.01]}})",
                                 "scene"),
                0.01);
}

TEST(Calibration, OpenCvJsonAndPlainListsAreTakenToo) {
  ExpectTheLens(ParseCalibration(R"({"image_width": 640, "image_height": 480, "camera_matrix":
    {"type_id": "opencv-matrix", "rows": 3, "cols": 3, "dt": "d",
     "data": [585.0, 0.0, 326.3, 0.0, 588.5, 235.8, 0.0, 0.0, 1.0]},
    "dist_coeffs": {"rows": 1, "cols": 5, "data": [-0.13, 0.045, 0.0006, -0.0004, 0.01]}})",
                                 "opencv.json"),
                0.01);
  ExpectTheLens(ParseCalibration("image_size: [640, 480]\n"
                                 "K: [[585, 0, 326.3], [0, 588.5, 235.8], [0, 0, 1]]\n"
                                 "D: [-0.13, 0.045, 0.0006, -0.0004]\n",
                                 "lists.yaml"),
                0.0);
}

TEST(Calibration, EurocSensorIsReadAsPublished) {
  const Result<CameraModel> camera = ParseCalibration(kEuroc, "sensor.yaml");
  ASSERT_TRUE(camera) << camera.error().Message();
  EXPECT_EQ(camera->width, 752);
  EXPECT_EQ(camera->fx, 458.654);
  EXPECT_EQ(camera->fy, 457.296);
  EXPECT_EQ(camera->cy, 248.375);
  EXPECT_THAT(camera->distortion,
              ElementsAre(-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0, 0, 0, 0));
}

TEST(Calibration, RationalModelHasEightCoefficients) {
  const std::string rational =
      tests::Replaced(tests::Replaced(tests::Replaced(kRos, "plumb_bob", "rational_polynomial"),
                                      "cols: 5", "cols: 8"),
                      "-0.0004, 0.01]", "-0.0004, 0.01, -0.1, 0.02, 0.001]");
  const Result<CameraModel> camera = ParseCalibration(rational, "ros");
  ASSERT_TRUE(camera) << camera.error().Message();
  EXPECT_THAT(camera->distortion,
              ElementsAre(-0.13, 0.045, 0.0006, -0.0004, 0.01, -0.1, 0.02, 0.001));
}

TEST(Calibration, FisheyeIsKnownByItsModelOrByItsFlag) {
  const std::string kalibr = tests::Replaced(kKalibr, "radtan", "equidistant");
  const std::string ros = tests::Replaced(
      tests::Replaced(tests::Replaced(kRos, "plumb_bob", "fisheye"), "cols: 5", "cols: 4"),
      ", 0.01]", "]");
  const std::string opencv = tests::Replaced(
      tests::Replaced(tests::Replaced(kOpenCv, "fisheye_model: 0", "fisheye_model: 1"), "rows: 5",
                      "rows: 4"),
      ", 1.0000000000000000e-02 ]", "]");
  for (const std::string& text : {kalibr, ros, opencv}) {
    const Result<CameraModel> camera = ParseCalibration(text, "lens");
    ASSERT_TRUE(camera) << camera.error().Message();
    EXPECT_EQ(camera->distortion_model, DistortionModel::kEquidistant);
    EXPECT_THAT(camera->distortion, ElementsAre(-0.13, 0.045, 0.0006, -0.0004, 0, 0, 0, 0));
  }
}

TEST(Calibration, IsKnownByContentWhateverTheEnding) {
  const tests::TemporaryFolder folder;
  ExpectTheLens(ReadCalibration(folder.Write("lens.txt", kOpenCv)), 0.01);
  ExpectTheLens(ReadCalibration(folder.Write("lens.yaml", kOwn)), 0.01);
  EXPECT_TRUE(ReadCalibration(tests::Courtyard() / "recording.json"));
  EXPECT_TRUE(ReadCalibration(tests::Courtyard() / "scene.json"));
}

TEST(Calibration, FocalLengthThatIsZeroNegativeOrNanIsRefused) {
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, "585", "0")), HasSubstr("has fx = 0, outside"));
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, "588.5", "-588.5")),
              HasSubstr("has fy = -588.5, outside"));
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, "585", "NaN")), HasSubstr("is not whole JSON"));
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, "585", "1e999")), HasSubstr("is not whole JSON"));
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, "585", "\"wide\"")),
              HasSubstr("\"fx\" is not a number"));
  EXPECT_THAT(Refusal(tests::Replaced(kOpenCv, "5.8500000000000000e+02", ".Nan")),
              AllOf(HasSubstr("\"camera_matrix.data\""), HasSubstr("not finite")));
  EXPECT_THAT(Refusal(tests::Replaced(kKalibr, "585.0", ".inf")), HasSubstr("not finite"));
  EXPECT_THAT(Refusal(tests::Replaced(kKalibr, "585.0", "0")), HasSubstr("has fx = 0, outside"));
}

TEST(Calibration, LensesOfNoWorldAreRefused) {
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, "585", "1e-308")),
              HasSubstr("fx = 1e-308, outside 6.4"));
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, "326.3", "1e6")), HasSubstr("cx = 1e+06, outside"));
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, "-0.13, 0.045", "-50, 0.045")),
              HasSubstr("folds the image"));
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, "-0.13, 0.045", "50, 0.045")),
              HasSubstr("less than half of their distance"));
  // Folds beyond the corners only.
  EXPECT_EQ(Refusal(tests::Replaced(kOwn, "-0.13, 0.045", "-0.4, 0.1")), "no error");
}

TEST(Calibration, ImageSizeMustBeOfThisWorld) {
  for (const char* width : {"0", "-640", "100001", "640.5", "1e12"}) {
    EXPECT_FALSE(ParseCalibration(tests::Replaced(kOwn, "640", width), "own")) << width;
    EXPECT_FALSE(
        ParseCalibration(tests::Replaced(kKalibr, "[640", std::string("[") + width), "kalibr"))
        << width;
  }
  EXPECT_THAT(Refusal(tests::Replaced(kRos, "image_width: 640\n", "")),
              HasSubstr("does not say how many pixels"));
}

TEST(Calibration, NumberOfCoefficientsMustFitTheModel) {
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, ", 0.01]", ", 0.01, 0.02]")), HasSubstr("4, 5 or 8"));
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, ", -0.0004, 0.01]", "]")),
              HasSubstr("has 3 distortion"));
  EXPECT_THAT(Refusal(tests::Replaced(kRos, "plumb_bob", "equidistant")),
              HasSubstr("(equidistant) has 4"));
  EXPECT_THAT(Refusal(tests::Replaced(kRos, "cols: 5", "cols: 8")),
              HasSubstr("rows times columns"));
}

TEST(Calibration, UnknownModelsAreNamed) {
  EXPECT_THAT(Refusal(tests::Replaced(kKalibr, "pinhole", "ds")), HasSubstr("\"ds\""));
  EXPECT_THAT(Refusal(tests::Replaced(kKalibr, "radtan", "fov")), HasSubstr("\"fov\""));
  EXPECT_THAT(Refusal(tests::Replaced(kOwn, "opencv-radtan", "magic")), HasSubstr("\"magic\""));
}

TEST(Calibration, MatrixThatIsNoCameraMatrixIsRefused) {
  EXPECT_THAT(Refusal("image_size: [640, 480]\nK: [585, 0.5, 326, 0, 588, 235, 0, 0, 1]\nD: []\n"),
              HasSubstr("skew"));
  EXPECT_THAT(Refusal("image_size: [640, 480]\nK: [585, 0, 0, 0, 588, 0, 326, 235, 1]\nD: []\n"),
              HasSubstr("row by row"));
  EXPECT_THAT(Refusal("image_size: [640, 480]\nK: [585, 588]\nD: []\n"), HasSubstr("not 3x3"));
}

TEST(Calibration, WhatIsNoCalibrationSaysWhatIs) {
  EXPECT_THAT(Refusal("{}"), HasSubstr("is no calibration"));
  EXPECT_THAT(Refusal("just words"), HasSubstr("is no calibration"));
  EXPECT_THAT(Refusal(""), HasSubstr("is empty"));
  EXPECT_THAT(Refusal("<?xml version=\"1.0\"?><opencv_storage>"), HasSubstr("is XML"));
  EXPECT_THAT(Refusal("a: [1, 2\nb: {"), HasSubstr("is not whole YAML"));
  EXPECT_THAT(Refusal(std::string(kOwn).substr(0, 90)), HasSubstr("cut short"));
}

TEST(Calibration, DeepOrMultipliedYamlIsRefusedInsteadOfFillingTheMemory) {
  EXPECT_FALSE(ParseCalibration(std::string(100'000, '['), "deep"));
  EXPECT_FALSE(ParseCalibration("a: &a [*a]\n", "cycle"));
  std::string bomb = "a0: &a0 [1,1,1,1,1,1,1,1,1,1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string one_before = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + one_before;
    for (int j = 0; j < 9; ++j) bomb += "," + one_before;
    bomb += "]\n";
  }
  EXPECT_THAT(Refusal(bomb), HasSubstr("too deep or too long"));
}

TEST(Calibration, FilesThatCannotBeReadAreNamed) {
  const tests::TemporaryFolder folder;
  EXPECT_THAT(tests::MessageOf(ReadCalibration(folder / "none.yaml")),
              AllOf(HasSubstr("none.yaml"), HasSubstr("no such file")));
  EXPECT_THAT(tests::MessageOf(ReadCalibration(folder.path())),
              HasSubstr("is a folder, not a file"));
  EXPECT_THAT(tests::MessageOf(ReadCalibration(folder.Write("empty.yaml", ""))),
              HasSubstr("is empty"));
  EXPECT_THAT(
      tests::MessageOf(ReadCalibration(folder.Write("large.yaml", std::string(5'000'000, ' ')))),
      HasSubstr("more than the"));
}

TEST(CalibrationText, IsReadBackToTheLastBitInEveryForm) {
  CameraModel camera;
  camera.width = 1921;
  camera.height = 1079;
  camera.fx = 1.0 / 3.0 * 4000.0;
  camera.fy = 1333.0 + 1e-10;
  camera.cx = 960.1234567890123;
  camera.cy = 539.9;
  const std::array<double, 8> lenses[] = {{},
                                          {-0.1, 1e-05, -3e-17, 0.2 / 3.0},
                                          {-0.1, 0.01, 1e-5, -1e-6, 0.123456789012345678},
                                          {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8},
                                          {0.03, -0.01, 0.004, -0.001}};
  for (std::size_t i = 0; i < std::size(lenses); ++i) {
    camera.distortion = lenses[i];
    camera.distortion_model =
        i == 4 ? DistortionModel::kEquidistant : DistortionModel::kBrownConrady;
    for (const auto form :
         {CalibrationForm::kOwn, CalibrationForm::kOpenCvYaml, CalibrationForm::kOpenCvJson,
          CalibrationForm::kRos, CalibrationForm::kKalibr, CalibrationForm::kEuroc}) {
      const auto text = CalibrationText(camera, form, {{"rms_px", 0.1}});
      const bool four_only = form == CalibrationForm::kKalibr || form == CalibrationForm::kEuroc;
      if (four_only && (i == 2 || i == 3)) {
        ASSERT_FALSE(text);
        EXPECT_THAT(text.error().Message(), HasSubstr("--model radtan4"));
        continue;
      }
      ASSERT_TRUE(text);
      const auto read = ParseCalibration(*text, "written");
      ASSERT_TRUE(read) << read.error().Message() << "\n" << *text;
      EXPECT_EQ(read->width, camera.width);
      EXPECT_EQ(read->height, camera.height);
      EXPECT_EQ(read->fx, camera.fx);
      EXPECT_EQ(read->fy, camera.fy);
      EXPECT_EQ(read->cx, camera.cx);
      EXPECT_EQ(read->cy, camera.cy);
      EXPECT_EQ(read->distortion_model, camera.distortion_model);
      EXPECT_EQ(read->distortion, camera.distortion) << *text;
    }
  }
}

}  // namespace
}  // namespace pleinair::devices
