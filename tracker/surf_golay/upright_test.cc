#include "tracker/surf_golay/upright_test.h"

#include "tracker/surf_golay/found_markers.h"
#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

constexpr double kProbeSide_px = 70.0;
/// Minimum correlation of the border, pixel by pixel, for a marker with a visible share below
/// kSurelyVisible. A lower one means that the reading is slightly displaced. Of 108 such markers
/// the one displaced had 0.16, the others 0.34 or more.
constexpr double kShiftedCorrelation = 0.25;

}  // namespace

std::array<BorderOrientation, 2> UprightTest::Orientations(std::array<Vec2, 4> corners_px) {
  double side = LongestSide(corners_px), scale = 1.0;
  int level = 0;
  while (side > kProbeSide_px && level + 1 < ReducedImages::kLevels) {
    side *= 0.5;
    scale *= 2.0;
    ++level;
  }
  for (Vec2& corner : corners_px) {
    corner = {(corner.x + 0.5) / scale - 0.5, (corner.y + 0.5) / scale - 0.5};
  }
  return orientation_test_.Evaluate(reduced_.Level(level), corners_px);
}

std::array<BorderOrientation, 2> UprightTest::Orientations(const Mat3& modules_from_undistorted) {
  std::array<Vec2, 4> corners = UndistortedSquareCorners(modules_from_undistorted);
  for (Vec2& corner : corners) corner = lens_.PixelOfUndistorted(corner);
  return Orientations(corners);
}

double UprightTest::UprightCorrelation(const BlockFitState& state) {
  const BorderOrientation observed = Orientations(state.modules_from_undistorted)[0];
  return !observed.mirrored && observed.first_corner == 0 ? observed.correlation : 0.0;
}

bool UprightTest::IsUpright(const SgReading& reading) {
  // Rim and quiet zone look the same from all sides, and a rotated content decodes to another word.
  // So the shapes of the border must fit better in this orientation than in any other.
  const BorderOrientation best = Orientations(reading.corners.px)[0];
  if (best.first_corner != 0 || best.mirrored) return false;
  // Edges of occluders resemble the marker's rim, but not the shapes of its border.
  return reading.visible_fraction >= kSurelyVisible || best.correlation >= kShiftedCorrelation;
}

}  // namespace pleinair::tracker
