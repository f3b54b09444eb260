#include <gtest/gtest.h>

#include <hwy/highway.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/tracker/alignment/alignment_scene.h"
#include "tests/tracker/surf/on_every_target.h"
#include "tracker/alignment/raster_kernels.h"
#include "tracker/alignment/reduced_images.h"
#include "tracker/pose/homography.h"

namespace pleinair::tracker {
namespace {

/// The marker's white at a point; the outermost modules are extended.
double WhiteAt(const MarkerPattern& marker_pattern, Vec2 modules) {
  const auto index = [&](double at) {
    return std::clamp(static_cast<int>(std::floor(at)), 0, marker_pattern.modules - 1);
  };
  return marker_pattern.white[index(modules.y) * marker_pattern.modules + index(modules.x)];
}

/// A pixel's box convolved with the blur's Gaussian, along one axis.
double PixelAndBlur(double t, double sigma) {
  const double scale = 1.0 / (sigma * std::numbers::sqrt2);
  return 0.5 * (std::erfc((t - 0.5) * scale) - std::erfc((t + 0.5) * scale));
}

/// Share of white in a pixel's light by brute force: 20 samples along a pixel.
double BruteForce(const CameraModel& camera, const MarkerPattern& marker_pattern,
                  const Mat3& modules, Vec2 pixel, double blur_px) {
  constexpr int kPerPixel = 20;
  const int reach = static_cast<int>(std::ceil((0.5 + 4.0 * blur_px) * kPerPixel));
  double sum = 0.0, all = 0.0;
  for (int j = -reach; j < reach; ++j) {
    const double dy = (j + 0.5) / kPerPixel, wy = PixelAndBlur(dy, blur_px);
    for (int i = -reach; i < reach; ++i) {
      const double dx = (i + 0.5) / kPerPixel, w = wy * PixelAndBlur(dx, blur_px);
      const Vec2 ray = UndistortPixel(camera, {pixel.x + dx, pixel.y + dy});
      const Vec2 undistorted{camera.fx * ray.x + camera.cx, camera.fy * ray.y + camera.cy};
      sum += w * WhiteAt(marker_pattern, Apply(modules, undistorted));
      all += w;
    }
  }
  return sum / all;
}

TEST(MarkerRaster, AgreesWithBruteForceSampling) {
  std::mt19937 random(3);
  struct Case {
    double side_px, tilt, blur_px;
    bool bent;
    double most;
  };
  // The samples' boxes are exact only for edges along the marker's axes. The rest of the error
  // comes from corners, tilted markers and one sample per pixel under wide blur.
  for (const Case& c : {Case{120, 0.0, 0.6, false, 0.01}, Case{120, 1.0, 0.4, false, 0.02},
                        Case{120, 0.8, 0.7, true, 0.01}, Case{42, 0.9, 0.5, false, 0.012},
                        Case{52, 0.2, 1.3, false, 0.012}, Case{16, 0.7, 0.6, false, 0.012},
                        Case{16, 1.2, 0.3, false, 0.03}}) {
    SCOPED_TRACE(testing::Message()
                 << c.side_px << " px, tilt " << c.tilt << ", blur " << c.blur_px);
    AlignmentView view;
    view.side_px = c.side_px;
    view.tilt = Radians(c.tilt);
    view.bent = c.bent;
    const AlignmentScene scene = MakeScene(view, {.light = {}});
    const Mat3 modules = scene.Guess(0.0).modules_from_undistorted;
    WindowRays rays;
    LookUpRays(*scene.lens, scene.window, &rays);
    MarkerRaster raster;
    PlaneMap map;
    PredictedImage image;
    raster.Render(scene.marker_pattern(), modules, rays, c.blur_px, &map, &image);
    double squares = 0.0;
    constexpr int kPixels = 40;
    for (int k = 0; k < kPixels; ++k) {
      const int x = static_cast<int>(random() % scene.window.width);
      const int y = static_cast<int>(random() % scene.window.height);
      const double expected = BruteForce(
          scene.camera, scene.marker_pattern(), modules,
          {scene.window.Full(scene.window.x0 + x), scene.window.Full(scene.window.y0 + y)},
          c.blur_px);
      const double error = image.white[y * scene.window.width + x] - expected;
      EXPECT_NEAR(error, 0.0, c.most) << x << ", " << y;
      squares += error * error;
    }
    EXPECT_LT(std::sqrt(squares / kPixels), 0.4 * c.most);
  }
}

TEST(MarkerRaster, ItsSlopesAreThoseOfItsPicture) {
  for (const double side : {16.0, 120.0}) {
    AlignmentView view;
    view.side_px = side;
    view.bent = false;
    const AlignmentScene scene = MakeScene(view, {.light = {}});
    const Mat3 modules = scene.Guess(0.0).modules_from_undistorted;
    WindowRays rays;
    LookUpRays(*scene.lens, scene.window, &rays);
    MarkerRaster raster;
    PlaneMap map;
    const auto render = [&](double dx, double dy) {
      PredictedImage image;
      raster.Render(scene.marker_pattern(), modules * Mat3{{1, 0, dx, 0, 1, dy, 0, 0, 1}}, rays,
                    0.6, &map, &image);
      return image;
    };
    constexpr double kStep = 0.25;  // Half the sample spacing.
    const PredictedImage at = render(0, 0), right = render(kStep, 0), left = render(-kStep, 0);
    const PredictedImage below = render(0, kStep), above = render(0, -kStep);
    double worst = 0.0, steepest = 0.0, squares = 0.0;
    for (std::size_t n = 0; n < at.white.size(); ++n) {
      const double by_x = (right.white[n] - left.white[n]) / (2 * kStep);
      const double by_y = (below.white[n] - above.white[n]) / (2 * kStep);
      worst = std::max({worst, std::fabs(at.white_x[n] - by_x), std::fabs(at.white_y[n] - by_y)});
      squares += (at.white_x[n] - by_x) * (at.white_x[n] - by_x) +
                 (at.white_y[n] - by_y) * (at.white_y[n] - by_y);
      steepest = std::max({steepest, std::fabs(by_x), std::fabs(by_y)});
    }
    EXPECT_GT(steepest, 0.2);
    EXPECT_LT(worst, 0.06) << side;
    EXPECT_LT(std::sqrt(squares / static_cast<double>(at.white.size())), 0.012) << side;
  }
}

TEST(MarkerRaster, LooksWhereTheLensAndThePrintSay) {
  const AlignmentScene scene = MakeScene({}, {.light = {}});
  const Mat3 modules = scene.Guess(0.0).modules_from_undistorted;
  WindowRays rays;
  LookUpRays(*scene.lens, scene.window, &rays);
  MarkerRaster raster;
  PlaneMap map;
  PredictedImage image;
  raster.Render(scene.marker_pattern(), modules, rays, 0.6, &map, &image);
  const auto exact = [&](double x, double y) {
    const Vec2 ray = UndistortPixel(scene.camera, {x, y});
    return Apply(modules, scene.lens->UndistortedOfRay(ray));
  };
  for (int y = 0; y < scene.window.height; y += 7) {
    for (int x = 0; x < scene.window.width; x += 7) {
      const double px = scene.window.x0 + x, py = scene.window.y0 + y;
      const std::size_t n = static_cast<std::size_t>(y) * scene.window.width + x;
      EXPECT_NEAR(map.column[n], exact(px, py).x, 1e-3);
      EXPECT_NEAR(map.row[n], exact(px, py).y, 1e-3);
      EXPECT_NEAR(map.column_x[n], 0.5 * (exact(px + 1, py).x - exact(px - 1, py).x), 1e-3);
      EXPECT_NEAR(map.column_y[n], 0.5 * (exact(px, py + 1).x - exact(px, py - 1).x), 1e-3);
      EXPECT_NEAR(map.row_x[n], 0.5 * (exact(px + 1, py).y - exact(px - 1, py).y), 1e-3);
      EXPECT_NEAR(map.row_y[n], 0.5 * (exact(px, py + 1).y - exact(px, py - 1).y), 1e-3);
    }
  }
}

TEST(MarkerRaster, RendersThePrintAloneAsWithItsSurroundings) {
  AlignmentView view;
  view.roll = Radians(0.8);
  const AlignmentScene scene = MakeScene(view, {.light = {}});
  const Mat3 modules = scene.Guess(0.0).modules_from_undistorted;
  WindowRays rays;
  LookUpRays(*scene.lens, scene.window, &rays);
  MarkerRaster raster;
  PlaneMap map;
  PredictedImage all, marker_pattern;
  std::vector<RowRange> ranges;
  for (const double blur : {0.3, 1.2, 3.5}) {
    raster.Render(scene.marker_pattern(), modules, rays, blur, &map, &all);
    raster.RenderMarkerOnly(scene.marker_pattern(), modules, rays, blur, &map, &marker_pattern,
                            &ranges);
    for (int y = 0; y < scene.window.height; ++y) {
      for (int x = 0; x < scene.window.width; ++x) {
        const std::size_t n = static_cast<std::size_t>(y) * scene.window.width + x;
        const bool inside = map.column[n] > 0 && map.column[n] < scene.marker_pattern().modules &&
                            map.row[n] > 0 && map.row[n] < scene.marker_pattern().modules;
        if (!inside) continue;
        ASSERT_TRUE(x >= ranges[y].begin && x < ranges[y].end);
        ASSERT_EQ(all.white[n], marker_pattern.white[n]);
        ASSERT_EQ(all.white_x[n], marker_pattern.white_x[n]);
        ASSERT_EQ(all.white_y[n], marker_pattern.white_y[n]);
      }
    }
  }
}

class RasterOnEveryTarget : public OnEveryTarget {};

TEST_P(RasterOnEveryTarget, DrawsWhatTheScalarReferenceDraws) {
  for (const double side : {12.0, 60.0}) {
    for (const double blur : {0.3, 1.4}) {
      for (const int width : {1, 3, 8, 15, 16, 17, 40, 71}) {
        AlignmentView view;
        view.side_px = side;
        AlignmentScene scene = MakeScene(view, {.light = {}});
        scene.window.width = width;
        WindowRays rays;
        LookUpRays(*scene.lens, scene.window, &rays);
        MarkerRaster simd, scalar(ScalarRasterKernels());
        PlaneMap map, scalar_map;
        PredictedImage image, scalar_image;
        std::vector<RowRange> ranges, scalar_ranges;
        const Mat3 modules = scene.Guess(0.0).modules_from_undistorted;
        simd.RenderMarkerOnly(scene.marker_pattern(), modules, rays, blur, &map, &image, &ranges);
        scalar.RenderMarkerOnly(scene.marker_pattern(), modules, rays, blur, &scalar_map,
                                &scalar_image, &scalar_ranges);
        for (std::size_t n = 0; n < image.white.size(); ++n) {
          ASSERT_NEAR(map.column[n], scalar_map.column[n], 1e-4);
          ASSERT_NEAR(map.row_y[n], scalar_map.row_y[n], 1e-4);
          ASSERT_NEAR(image.white[n], scalar_image.white[n], 2e-4);
          ASSERT_NEAR(image.white_x[n], scalar_image.white_x[n], 2e-4);
          ASSERT_NEAR(image.white_y[n], scalar_image.white_y[n], 2e-4);
        }
        for (std::size_t y = 0; y < ranges.size(); ++y) {
          ASSERT_NEAR(ranges[y].begin, scalar_ranges[y].begin, 1);
          ASSERT_NEAR(ranges[y].end, scalar_ranges[y].end, 1);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, RasterOnEveryTarget,
                         testing::ValuesIn(hwy::SupportedAndGeneratedTargets()));

TEST(LensGrid, AgreesWithTheExactInverseOfTheLens) {
  for (const double k1 : {-0.25, 0.0, 0.1}) {
    CameraModel camera = SceneCamera(false);
    camera.distortion[0] = k1;
    const LensGrid lens(camera);
    for (double y = 0.3; y < camera.height; y += 13.7) {
      std::array<float, 20> row_x{}, row_y{};
      lens.UndistortRow(0.4, 15.9, 20, y, row_x.data(), row_y.data());
      for (int k = 0; k < 20; ++k) {
        const double x = 0.4 + 15.9 * k;
        const Vec2 expected = lens.UndistortedOfRay(UndistortPixel(camera, {x, y}));
        const Vec2 undistorted = lens.Undistort(x, y);
        EXPECT_NEAR(undistorted.x, expected.x, 2e-3);
        EXPECT_NEAR(undistorted.y, expected.y, 2e-3);
        EXPECT_NEAR(row_x[k], undistorted.x, 1e-4);
        EXPECT_NEAR(row_y[k], undistorted.y, 1e-4);
        const Vec2 back = lens.PixelOfUndistorted(undistorted);
        EXPECT_NEAR(back.x, x, 2e-3);
        EXPECT_NEAR(back.y, y, 2e-3);
      }
    }
  }
}

TEST(ReducedImages, AreRoundedMeansOfSquares) {
  std::mt19937 random(1);
  Image<std::uint8_t> image(37, 22, 1);
  for (int y = 0; y < 22; ++y) {
    for (int x = 0; x < 37; ++x) image(x, y) = static_cast<std::uint8_t>(random());
  }
  ReducedImages reduced;
  reduced.SetImage(image.view());
  const auto half = reduced.Level(1);
  ASSERT_EQ(half.width(), 18);
  ASSERT_EQ(half.height(), 11);
  for (int y = 0; y < 11; ++y) {
    for (int x = 0; x < 18; ++x) {
      const int sum = image(2 * x, 2 * y) + image(2 * x + 1, 2 * y) + image(2 * x, 2 * y + 1) +
                      image(2 * x + 1, 2 * y + 1);
      EXPECT_EQ(half.row(y)[x], (sum + 2) / 4);
    }
  }
  EXPECT_EQ(reduced.Level(2).width(), 9);
  EXPECT_EQ(reduced.Level(5).height(), 0);
}

}  // namespace
}  // namespace pleinair::tracker
