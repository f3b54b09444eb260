#include "app/sinks/tum_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

namespace pleinair::app {
namespace {

Mat3 About(Vec3 axis, double angle) {
  const Vec3 a = Normalized(axis);
  const double c = std::cos(angle), s = std::sin(angle), k = 1 - c;
  return {{c + a.x * a.x * k, a.x * a.y * k - a.z * s, a.x * a.z * k + a.y * s,
           a.y * a.x * k + a.z * s, c + a.y * a.y * k, a.y * a.z * k - a.x * s,
           a.z * a.x * k - a.y * s, a.z * a.y * k + a.x * s, c + a.z * a.z * k}};
}

/// The numbers of the line of one pose of the camera in the marker frame.
std::array<double, 8> Line(const Transform<Marker, Camera>& marker_from_camera) {
  Observation at;
  at.timestamp_ns = 1'066'667'000;
  at.camera_from_marker = marker_from_camera.Inverse();
  std::istringstream text(TumText({at}));
  std::string comment;
  std::getline(text, comment);
  std::array<double, 8> numbers{};
  for (double& number : numbers) text >> number;
  return numbers;
}

TEST(TumWriter, WritesTheCameraInTheMarkerFrame) {
  const auto line = Line({About({0, 0, 1}, std::numbers::pi / 2), {1, 2, 3}});
  EXPECT_DOUBLE_EQ(line[0], 1.066667);
  EXPECT_NEAR(line[1], 1, 1e-8);
  EXPECT_NEAR(line[2], 2, 1e-8);
  EXPECT_NEAR(line[3], 3, 1e-8);
  EXPECT_NEAR(line[6], std::sqrt(0.5), 1e-8);
  EXPECT_NEAR(line[7], std::sqrt(0.5), 1e-8);
}

TEST(TumWriter, GivesTheQuaternionOfEveryAxisAndAngle) {
  for (const Vec3 axis : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, -2, 0.5}, {-1, -1, 3}}) {
    for (const double angle : {1e-5, 0.5, 1.6, 3.0, std::numbers::pi - 1e-4, 4.0, 6.0}) {
      const auto line = Line({About(axis, angle), {}});
      const Vec3 unit = Normalized(axis);
      const double sign = std::cos(angle / 2) < 0 ? -1.0 : 1.0;
      EXPECT_NEAR(line[4], sign * std::sin(angle / 2) * unit.x, 1e-8) << angle;
      EXPECT_NEAR(line[5], sign * std::sin(angle / 2) * unit.y, 1e-8) << angle;
      EXPECT_NEAR(line[6], sign * std::sin(angle / 2) * unit.z, 1e-8) << angle;
      EXPECT_NEAR(line[7], sign * std::cos(angle / 2), 1e-8) << angle;
    }
  }
}

}  // namespace
}  // namespace pleinair::app
