// The search on the screen against exact heights and rays, on a rolling field.
#include "content/draping/screen_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/content/draping/made_surfaces.h"

namespace pleinair::content {
namespace {

using tests::MeshMaker;

/// Ridges that hide ground behind them.
double Rolling(double x, double y) {
  return 2.5 * std::sin(0.16 * x) * std::cos(0.11 * y) + 1.5 * std::sin(0.07 * y + 1.0) + 0.02 * x;
}

SurfaceIndex RollingField() {
  MeshMaker maker;
  maker.Field(128, 80.0, Rolling);
  return *SurfaceIndex::Create(maker.Take());
}

CameraModel Pinhole(int width, int height, double f) {
  CameraModel camera;
  camera.width = width;
  camera.height = height;
  camera.fx = camera.fy = f;
  camera.cx = (width - 1) / 2.0;
  camera.cy = (height - 1) / 2.0;
  return camera;
}

/// A camera that looks north, its axis `pitch_deg` above the horizon.
Transform<World, Camera> LookingNorth(Vec3 centre, double pitch_deg) {
  const double c = std::cos(pitch_deg * M_PI / 180), s = std::sin(pitch_deg * M_PI / 180);
  // Columns: the camera's right, down and forward in the world.
  return {{{1, 0, 0, 0, s, c, 0, -c, s}}, centre};
}

/// True if a triangle, of all, crosses the ray to a point more than 1 cm before it: by the signs of
/// volumes.
bool RayIsStopped(const SurfaceIndex& index, const Vec3& eye, const Vec3& point) {
  const Vec3 end = eye + (point - eye) * (1.0 - 0.01 / Norm(point - eye));
  const auto volume = [](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return Dot(Cross(b - a, c - a), d - a);
  };
  for (std::uint32_t i = 0; i < index.mesh().triangles.size(); ++i) {
    const auto [a, b, c] = index.Corners(i);
    if ((volume(eye, a, b, c) > 0.0) == (volume(end, a, b, c) > 0.0)) continue;
    const bool ab = volume(eye, end, a, b) > 0.0, bc = volume(eye, end, b, c) > 0.0;
    const bool ca = volume(eye, end, c, a) > 0.0;
    if (ab == bc && bc == ca) return true;
  }
  return false;
}

struct Scores {
  double rms_m = 0.0, bound_m = 0.0;
  int visible = 0, hidden = 0, missed = 0, false_alarms = 0;
};

Scores ScoresAt(const SurfaceIndex& index, const Transform<World, Camera>& camera_pose) {
  const SurfaceView view(index, Pinhole(640, 480, 520.0), camera_pose);
  Scores scores;
  double squares = 0.0, bounds = 0.0;
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 60; ++column) {
      const Vec2 at{-70.0 + 2.41 * column, -70.0 + 2.43 * row};
      const double exact_m = *index.HeightAt(at, {});
      const Vec3 point{at.x, at.y, exact_m};
      const auto pixel = view.PixelOf(point);
      if (!pixel || !view.InPicture(*pixel)) continue;
      const std::vector lines{tests::LineOf({{at.x, at.y, 0}})};
      const ScreenDrape found = DrapeOnScreen(lines, view, index, {});
      const bool is_flagged = found.hidden.at(0).at(0);
      if (RayIsStopped(index, view.centre(), point)) {
        ++scores.hidden;
        scores.missed += is_flagged ? 0 : 1;
        continue;
      }
      ++scores.visible;
      scores.false_alarms += is_flagged ? 1 : 0;
      const double step = 0.05;
      const double slope =
          std::hypot((Rolling(at.x + step, at.y) - Rolling(at.x - step, at.y)) / (2 * step),
                     (Rolling(at.x, at.y + step) - Rolling(at.x, at.y - step)) / (2 * step));
      const double distance_m = Norm(point - view.centre());
      // Half a pixel without its stretch by a grazing view: stricter than the footprint.
      const double bound_m = distance_m * std::pow(2.0, -23) + 0.5 * slope * distance_m / 520.0;
      const double error_m = found.draped.pieces[0].vertices[0].at.xyz.z - exact_m;
      squares += error_m * error_m;
      bounds += bound_m * bound_m;
    }
  }
  scores.rms_m = std::sqrt(squares / scores.visible);
  scores.bound_m = std::sqrt(bounds / scores.visible);
  return scores;
}

class ScreenSearch : public ::testing::TestWithParam<double> {};

TEST_P(ScreenSearch, FindsHeightsAndWhatIsHidden) {
  const SurfaceIndex index = RollingField();
  const double pitch_deg = GetParam();
  const bool is_high = pitch_deg < -30.0;
  const Vec3 centre{3.0, is_high ? -45.0 : -75.0, is_high ? 60.0 : 4.0};
  const Scores scores = ScoresAt(index, LookingNorth(centre, pitch_deg));
  RecordProperty("rms_mm", std::to_string(1e3 * scores.rms_m));
  RecordProperty("bound_mm", std::to_string(1e3 * scores.bound_m));
  RecordProperty("visible", scores.visible);
  RecordProperty("hidden", scores.hidden);
  RecordProperty("missed", scores.missed);
  RecordProperty("false_alarms", scores.false_alarms);
  EXPECT_GT(scores.visible, 300);
  EXPECT_LE(scores.rms_m, scores.bound_m);
  EXPECT_LE(scores.false_alarms, 0.01 * scores.visible);
  EXPECT_LE(scores.missed, 0.01 * scores.hidden);
}

// Level cameras and those that look up are where the printed test of depths fails.
INSTANTIATE_TEST_SUITE_P(Pitches, ScreenSearch,
                         ::testing::Values(-60.0, -40.0, -20.0, -5.0, 0.0, 5.0));

TEST(ScreenDrape, GivesVerticesOfTheFileWithExactHeightsWhereHidden) {
  const SurfaceIndex index = RollingField();
  const SurfaceView view(index, Pinhole(640, 480, 520.0), LookingNorth({3, -75, 4}, -3.0));
  std::vector<LineToDrape> lines{
      tests::LineOf({{-10, -60, 0}, {0, -20, 0}, {5, 30, 0}, {9, 70, 0}}),
      tests::LineOf({{0, -79, 0}, {0, -78, 0}, {0, 200, 0}})};
  lines[0].above_m = 0.5;
  const ScreenDrape screen = DrapeOnScreen(lines, view, index, {});
  ASSERT_EQ(screen.draped.pieces.size(), 2U);
  EXPECT_EQ(screen.draped.report.off_target, 1U);
  EXPECT_EQ(screen.draped.report.vertices_out, 6U);
  for (std::size_t p = 0; p < 2; ++p) {
    const DrapedPiece& piece = screen.draped.pieces[p];
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
      const Vec3& at = piece.vertices[i].at.xyz;
      const double exact_m = *index.HeightAt({at.x, at.y}, {}) + lines[p].above_m;
      const bool hidden =
          IsHiddenFrom(index, view.centre(), {at.x, at.y, exact_m - lines[p].above_m});
      EXPECT_NEAR(at.z, exact_m, hidden ? 1e-9 : 0.1) << p << " " << i;
      EXPECT_EQ(screen.hidden[p][i], hidden) << p << " " << i;
    }
  }
}

TEST(IsHiddenFrom, AgreesWithABoxBeforeAWall) {
  MeshMaker maker;
  maker.Box({-1, 4, 0}, {1, 5, 2});
  maker.Quad({-10, 10, 0}, {10, 10, 0}, {10, 10, 6}, {-10, 10, 6});
  const auto index = SurfaceIndex::Create(maker.Take());
  const Vec3 eye{0, 0, 1};
  EXPECT_TRUE(IsHiddenFrom(*index, eye, {0, 10, 1}));
  EXPECT_TRUE(IsHiddenFrom(*index, eye, {0, 5, 1}));   // Its back.
  EXPECT_FALSE(IsHiddenFrom(*index, eye, {0, 4, 1}));  // Its front.
  EXPECT_FALSE(IsHiddenFrom(*index, eye, {0, 10, 5}));
  EXPECT_FALSE(IsHiddenFrom(*index, eye, {5, 10, 1}));
}

}  // namespace
}  // namespace pleinair::content
