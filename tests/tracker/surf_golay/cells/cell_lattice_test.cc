// Tests the detection of cells by the corners between them, and of the corners.
#include "tracker/surf_golay/cells/cell_lattice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/tracker/surf_golay/sg_test_scenes.h"
#include "tracker/pose/homography.h"
#include "tracker/surf_golay/sg_layout.h"

namespace pleinair::tracker {
namespace {

/// A dark parallelogram on a light background with lens blur. Its corner is at `corner`, its sides
/// are along `a` and `b` (unit vectors).
GreyImage Wedge(Vec2 corner, Vec2 a, Vec2 b) {
  GreyImage image(64, 64);
  const double cross = a.x * b.y - a.y * b.x;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const Vec2 to = Vec2{static_cast<double>(x), static_cast<double>(y)} - corner;
      // Distances from the two sides, positive inside.
      const double from_a = (a.x * to.y - a.y * to.x) * (cross > 0 ? 1 : -1);
      const double from_b = (to.x * b.y - to.y * b.x) * (cross > 0 ? 1 : -1);
      const auto inside = [](double distance) { return 0.5 * (1 + std::erf(distance / 0.9)); };
      image(x, y) =
          static_cast<std::uint8_t>(std::lround(180.0 - 120.0 * inside(from_a) * inside(from_b)));
    }
  }
  return image;
}

ImageView<const std::uint8_t> View(const GreyImage& image) {
  return {image.data(), image.width(), image.height(), 1, image.width()};
}

TEST(CornerPoints, LieWhereTheSidesMeet) {
  CornerPoints detector;
  for (const double angle_deg : {0.0, 25.0, 70.0, 190.0}) {
    for (const double opening_deg : {60.0, 90.0, 120.0}) {
      SCOPED_TRACE(testing::Message() << angle_deg << " + " << opening_deg);
      const double a = FromDegrees(angle_deg).value();
      const double b = FromDegrees(angle_deg + opening_deg).value();
      const Vec2 truth{31.3, 32.8};
      const auto& corners =
          detector.Find(View(Wedge(truth, {std::cos(a), std::sin(a)}, {std::cos(b), std::sin(b)})));
      const CornerPoint* nearest = nullptr;
      for (const CornerPoint& corner : corners) {
        if (nearest == nullptr || Norm(corner.at_px - truth) < Norm(nearest->at_px - truth)) {
          nearest = &corner;
        }
      }
      ASSERT_NE(nearest, nullptr);
      EXPECT_LT(Norm(nearest->at_px - truth), 0.6);
    }
  }
}

TEST(CornerPoints, AreNotFoundOnEdgesNorWhereNothingIs) {
  CornerPoints detector;
  GreyImage image(80, 60);
  EXPECT_TRUE(detector.Find(View(image)).empty());
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) image(x, y) = 2 * x + y > 110 ? 200 : 40;
  }
  EXPECT_TRUE(detector.Find(View(image)).empty());
  for (const int size : {0, 1, 5, 8}) {
    EXPECT_TRUE(detector.Find(View(GreyImage(size, size))).empty()) << size;
  }
}

/// Maximum distance of a content corner from the nearest true one, in cells. A lattice does not
/// determine its rotation by quarter turns.
double CellsApart(const CameraModel& camera, const Mat3& modules_from_undistorted,
                  const RenderedMarker& marker) {
  const auto square = TrueCorners(camera, marker);
  const Mat3 pixel_from_unit = HomographyToQuad(square);
  constexpr double kHalf = 0.5 * sg::kCells * sg::kCell / (0.5 * sg::kEdge);
  std::array<Vec2, 4> truth;
  for (int i = 0; i < 4; ++i) truth[i] = Apply(pixel_from_unit, kSquareCorners[i] * kHalf);
  const double cell = Norm(truth[0] - truth[1]) / sg::kCells;
  double farthest = 0.0;
  for (const Vec2& corner : kSquareCorners) {
    constexpr double kMiddle = 0.5 * sg::kModules, kSide = 0.5 * sg::kCells * sg::kCell;
    const Vec2 at = Apply(Adjugate(modules_from_undistorted),
                          {kMiddle + kSide * corner.x, kMiddle + kSide * corner.y});
    double nearest = 1e9;
    for (const Vec2& other : truth) nearest = std::min(nearest, Norm(at - other) / cell);
    farthest = std::max(farthest, nearest);
  }
  return farthest;
}

TEST(CellLattice, FindsTheCellsOfAMarkerWhoseBorderIsCoveredWholly) {
  const CameraModel camera = SgCamera();
  const LensGrid lens(camera);
  CellLattice lattice(lens);
  int found = 0, all = 0;
  for (const int number : {17, 169, 736, 2032, 2741, 3814}) {
    for (const double tilt_deg : {0.0, 30.0, 50.0}) {
      RenderedMarker marker = SgMarkerAt(camera, number, {161, 118}, 130, tilt_deg, 40, 15);
      marker.cover = [](Vec2 at) {
        const Vec2 p = ModulesOf(at);
        return std::max(std::fabs(p.x - 20), std::fabs(p.y - 20)) > 10.5 ? 0.3 : -1.0;
      };
      const GreyImage image =
          RenderMarkers(camera, {marker}, {.blur_px = 0.6, .noise_codes = 1.0, .seed = 1});
      std::vector<LatticeGuess> guesses;
      lattice.Find(View(image), 1.0, &guesses);
      ++all;
      // A row of cells without visible corners may be missing on either side.
      for (const LatticeGuess& guess : guesses) {
        bool here = false;
        for (int shift = 0; shift < 9; ++shift) {
          Mat3 by;
          const int column = shift % 3 - 1, row = shift / 3 - 1;
          by(0, 2) = sg::kCell * column;
          by(1, 2) = sg::kCell * row;
          here = here || CellsApart(camera, by * guess.modules_from_undistorted, marker) < 0.3;
        }
        if (!here) continue;
        ++found;
        break;
      }
    }
  }
  EXPECT_GE(found, all - 1);
}

TEST(CellLattice, FindsNothingInAPictureOfNothing) {
  const CameraModel camera = SgCamera();
  const LensGrid lens(camera);
  CellLattice lattice(lens);
  std::vector<LatticeGuess> guesses(3);
  lattice.Find(View(GreyImage(camera.width, camera.height)), 1.0, &guesses);
  EXPECT_TRUE(guesses.empty());
  lattice.Find({}, 1.0, &guesses);
  EXPECT_TRUE(guesses.empty());
}

}  // namespace
}  // namespace pleinair::tracker
