#include "app/project/heading_from_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "scene/marker_heading.h"

namespace pleinair::app {
namespace {

/// Pose of a camera that looks to `view_deg`, `down_deg` below the horizon, rolled by `roll_deg`.
Transform<Camera, Marker> Looking(double view_deg, double down_deg, double roll_deg,
                                  const Mat3& marker_from_world) {
  const double a = view_deg * kRadiansPerDegree, e = down_deg * kRadiansPerDegree;
  const double r = roll_deg * kRadiansPerDegree;
  const Vec3 forward{std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), -std::sin(e)};
  const Vec3 right{std::cos(a), -std::sin(a), 0.0};
  const Vec3 down = Cross(forward, right);
  const Vec3 x = right * std::cos(r) + down * std::sin(r);
  const Vec3 y = down * std::cos(r) - right * std::sin(r);
  const Mat3 camera_from_world{{x.x, x.y, x.z, y.x, y.y, y.z, forward.x, forward.y, forward.z}};
  return {camera_from_world * marker_from_world.Transposed(), {0.0, 0.0, 3.0}};
}

TEST(HeadingFromView, IsThatOfTheMarkerForEveryViewAndRoll) {
  for (const bool upright : {false, true}) {
    for (const double heading_deg : {0.0, 75.0, 200.0, 342.0}) {
      scene::MarkerDescription marker;
      marker.heading = FromDegrees(heading_deg);
      marker.upright = upright;
      const Mat3 marker_from_world = scene::MarkerFromWorld(marker);
      for (const double view_deg : {10.0, 130.0, 300.0}) {
        const auto pose = Looking(view_deg, 35.0, 90.0, marker_from_world);
        const auto found_deg = HeadingFromView(view_deg, pose, upright);
        ASSERT_TRUE(found_deg);
        EXPECT_NEAR(std::remainder(*found_deg - heading_deg, 360.0), 0.0, 1e-9)
            << upright << ' ' << heading_deg << ' ' << view_deg;
        EXPECT_GE(*found_deg, 0.0);
      }
    }
  }
}

TEST(HeadingFromView, IsUnknownFromStraightAbove) {
  const Mat3 marker_from_world = scene::MarkerFromWorld({});
  EXPECT_FALSE(HeadingFromView(10.0, Looking(10.0, 71.0, 0.0, marker_from_world), false));
  EXPECT_TRUE(HeadingFromView(10.0, Looking(10.0, 69.0, 0.0, marker_from_world), false));
}

}  // namespace
}  // namespace pleinair::app
