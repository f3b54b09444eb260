#include "tracker/surf_golay/upright_test.h"

#include "tracker/surf_golay/found_markers.h"
#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

constexpr double kProbeSide_px = 70.0;
/// Correlation of its border, pixel by pixel, below which a marker of which not even so much is
/// observed (kSurelyVisible) is a little beside. (Of 108 the one that was had .16, of the others
/// none less than .34.)
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
  // Rim and margin look the same from all sides, and a turned content reads as some other word: the
  // border's shapes must fit better this way round than any other.
  const BorderOrientation best = Orientations(reading.corners.px)[0];
  if (best.first_corner != 0 || best.mirrored) return false;
  // Edges of covers pass for the marker's rim, but not for its border's shapes.
  return reading.visible_fraction >= kSurelyVisible || best.correlation >= kShiftedCorrelation;
}

}  // namespace pleinair::tracker
