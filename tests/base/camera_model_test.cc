#include "base/camera_model.h"

#include <gtest/gtest.h>

namespace pleinair {
namespace {

CameraModel Lens(DistortionModel model, std::array<double, 8> distortion) {
  return {640, 480, 585, 588, 326.3, 235.8, model, distortion};
}

// Maximum distance between an image point and itself after undistortion and distortion.
double WorstRoundTripPx(const CameraModel& camera) {
  double worst = 0.0;
  for (int v = 0; v < camera.height; v += 20) {
    for (int u = 0; u < camera.width; u += 20) {
      const Vec2 pixel{static_cast<double>(u), static_cast<double>(v)};
      const Vec2 ray = UndistortPixel(camera, pixel);
      const Vec2 again = ProjectToPixel(camera, Point<Camera>{{ray.x * 3, ray.y * 3, 3.0}});
      worst = std::max(worst, Norm(again - pixel));
    }
  }
  return worst;
}

TEST(CameraModel, PointOnTheAxisFallsOnThePrincipalPoint) {
  for (const DistortionModel model :
       {DistortionModel::kBrownConrady, DistortionModel::kEquidistant}) {
    const CameraModel camera = Lens(model, {-0.13, 0.045, 0.0006, -0.0004});
    EXPECT_EQ(ProjectToPixel(camera, Point<Camera>{{0, 0, 2}}), (Vec2{326.3, 235.8}));
  }
}

TEST(CameraModel, PinholeProjectsByHand) {
  const CameraModel camera = Lens(DistortionModel::kBrownConrady, {});
  EXPECT_FALSE(camera.HasDistortion());
  const Vec2 pixel = ProjectToPixel(camera, Point<Camera>{{1, -1, 4}});
  EXPECT_DOUBLE_EQ(pixel.x, 326.3 + 585.0 / 4);
  EXPECT_DOUBLE_EQ(pixel.y, 235.8 - 588.0 / 4);
}

// An equidistant lens without coefficients maps the angle to the radius: f·π/4 at 45°.
TEST(CameraModel, EquidistantRadiusIsTheAngle) {
  const CameraModel camera = Lens(DistortionModel::kEquidistant, {});
  EXPECT_TRUE(camera.HasDistortion());
  EXPECT_NEAR(ProjectToPixel(camera, Point<Camera>{{2, 0, 2}}).x - 326.3, 585 * 0.78539816, 1e-5);
}

// x(1 + k1 r² + …) + 2 p1 x y + p2 (r² + 2x²) at (0.3, −0.2) with r² = 0.13, by hand.
TEST(CameraModel, BrownConradyFollowsItsFormula) {
  const CameraModel camera = Lens(DistortionModel::kBrownConrady, {-0.2, 0.1, 0.001, 0.002, 0.05});
  double x = 0, y = 0;
  DistortNormalized(camera, 0.3, -0.2, &x, &y);
  const double radial = 1 - 0.2 * 0.13 + 0.1 * 0.0169 + 0.05 * 0.002197;
  EXPECT_NEAR(x, 0.3 * radial + 2 * 0.001 * 0.3 * -0.2 + 0.002 * (0.13 + 0.18), 1e-15);
  EXPECT_NEAR(y, -0.2 * radial + 0.001 * (0.13 + 0.08) + 2 * 0.002 * 0.3 * -0.2, 1e-15);
}

TEST(CameraModel, EveryPixelComesBackFromUndistorting) {
  EXPECT_LT(WorstRoundTripPx(Lens(DistortionModel::kBrownConrady, {})), 1e-10);
  EXPECT_LT(WorstRoundTripPx(Lens(DistortionModel::kBrownConrady, {-0.13, 0.045, 0.0006, -0.0004})),
            1e-9);
  EXPECT_LT(WorstRoundTripPx(Lens(DistortionModel::kBrownConrady,
                                  {-0.28, 0.07, 0.0002, 0.00002, 0.01, 0.02, 0.003, 0.0004})),
            1e-9);
  EXPECT_LT(WorstRoundTripPx(Lens(DistortionModel::kEquidistant, {-0.01, 0.02, -0.01, 0.002})),
            1e-9);
}

}  // namespace
}  // namespace pleinair
