#include <vector>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "base/camera_model.h"

namespace pleinair::devices {
namespace {

// Points in front of the camera, to 35° off its axis.
std::vector<cv::Point3d> PointsInFront() {
  std::vector<cv::Point3d> points;
  for (int y = -5; y <= 5; ++y) {
    for (int x = -5; x <= 5; ++x) points.emplace_back(0.1 * x, 0.1 * y, 1.0 + 0.03 * (x + y));
  }
  return points;
}

double WorstDifferencePx(const CameraModel& camera, const std::vector<cv::Point2d>& expected) {
  const std::vector<cv::Point3d> points = PointsInFront();
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 pixel =
        ProjectToPixel(camera, Point<Camera>{{points[i].x, points[i].y, points[i].z}});
    worst = std::max(worst, Norm(pixel - Vec2{expected[i].x, expected[i].y}));
  }
  return worst;
}

const cv::Matx33d kMatrix(585, 0, 326.3, 0, 588.5, 235.8, 0, 0, 1);
const cv::Vec3d kZero(0, 0, 0);

TEST(CameraModel, AgreesWithOpenCvsRationalModel) {
  const CameraModel camera{640,
                           480,
                           585,
                           588.5,
                           326.3,
                           235.8,
                           DistortionModel::kBrownConrady,
                           {-0.28, 0.07, 0.0002, -0.0004, 0.01, 0.02, 0.003, 0.0004}};
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(PointsInFront(), kZero, kZero, kMatrix,
                    std::vector<double>(camera.distortion.begin(), camera.distortion.end()),
                    pixels);
  EXPECT_LT(WorstDifferencePx(camera, pixels), 1e-9);
}

TEST(CameraModel, AgreesWithOpenCvsFisheyeModel) {
  const CameraModel camera{640,
                           480,
                           585,
                           588.5,
                           326.3,
                           235.8,
                           DistortionModel::kEquidistant,
                           {-0.01, 0.02, -0.01, 0.002}};
  std::vector<cv::Point2d> pixels;
  cv::fisheye::projectPoints(PointsInFront(), pixels, kZero, kZero, kMatrix,
                             std::vector<double>{-0.01, 0.02, -0.01, 0.002});
  EXPECT_LT(WorstDifferencePx(camera, pixels), 1e-9);
}

}  // namespace
}  // namespace pleinair::devices
