#include "tracker/calibration/lens_residual.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tests/tracker/calibration/board_rendering.h"

namespace pleinair::tracker {
namespace {

TEST(LensDerivatives, AgreeWithDifferences) {
  for (const bool wide : {false, true}) {
    CameraModel camera = BoardCamera();
    camera.distortion = {-0.2, 0.05, 0.001, -0.002, 0.01, 0.02, -0.01, 0.005};
    if (wide) {
      camera.distortion_model = DistortionModel::kEquidistant;
      camera.distortion = {0.03, -0.01, 0.004, -0.001};
    }
    PoseNumbers pose = NumbersOf(BoardPoses(camera, 0.3, 40.0)[3]);
    LensNumbers lens = NumbersOf(camera);
    for (const Vec2 at : {Vec2{0.11, -0.07}, Vec2{-0.02, 0.09}}) {
      PixelDerivatives derivatives;
      ProjectBoardPoint(camera, pose.data(), at, &derivatives);
      const auto expect = [&](double* number, const double* stated, int stride) {
        const double step = 1e-6 * std::max(1.0, std::fabs(*number));
        *number += step;
        SetLensNumbers(lens.data(), &camera);
        const Vec2 plus = ProjectBoardPoint(camera, pose.data(), at, nullptr);
        *number -= 2.0 * step;
        SetLensNumbers(lens.data(), &camera);
        const Vec2 minus = ProjectBoardPoint(camera, pose.data(), at, nullptr);
        *number += step;
        SetLensNumbers(lens.data(), &camera);
        const Vec2 slope = (plus - minus) * (0.5 / step);
        EXPECT_NEAR(stated[0], slope.x, 1e-5 * std::max(1.0, std::fabs(slope.x)));
        EXPECT_NEAR(stated[stride], slope.y, 1e-5 * std::max(1.0, std::fabs(slope.y)));
      };
      for (std::size_t i = 0; i < (wide ? 8 : 12); ++i) {
        expect(&lens[i], &derivatives.by_lens[i], kLensNumbers);
      }
      for (std::size_t i = 0; i < 6; ++i) {
        expect(&pose[i], &derivatives.by_pose[i], kPoseNumbers);
      }
    }
  }
}

}  // namespace
}  // namespace pleinair::tracker
