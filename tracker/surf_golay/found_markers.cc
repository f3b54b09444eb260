#include "tracker/surf_golay/found_markers.h"

#include <algorithm>

#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

/// Distance of two fits, in shares of the side, above which they are certainly two markers.
constexpr double kOtherPlace = 0.15;

bool Inside(const std::array<Vec2, 4>& quad, Vec2 point) {
  const auto right_of = [&](int i) {
    const Vec2 along = quad[(i + 1) % 4] - quad[i], to = point - quad[i];
    return along.x * to.y - along.y * to.x > 0.0;
  };
  const bool first = right_of(0);
  return right_of(2) == first && right_of(1) == first && right_of(3) == first;
}

Vec2 CentreOf(const std::array<Vec2, 4>& quad) {
  return (quad[0] + quad[1] + quad[2] + quad[3]) * 0.25;
}

/// Whether a reading with a small visible share lies, with other corners, on the unoccluded border
/// of a marker. An occluder of that marker's cells was then read as another marker's.
bool ContradictsBorder(const SgReading& reading, std::span<const Mat3> unread_borders) {
  if (reading.visible_fraction >= kSurelyVisible) return false;
  const std::array<Vec2, 4> corners = UndistortedSquareCorners(reading.modules_from_undistorted);
  return std::ranges::any_of(unread_borders, [&](const Mat3& unread) {
    const std::array<Vec2, 4> open = UndistortedSquareCorners(unread);
    return Inside(open, CentreOf(corners)) &&
           MaxCornerDistance(open, corners) > kOtherPlace * LongestSide(open);
  });
}

}  // namespace

bool FoundMarkers::IsTaken(const Mat3& modules_from_undistorted, double visible) const {
  const std::array<Vec2, 4> corners = UndistortedSquareCorners(modules_from_undistorted);
  const Vec2 centre = CentreOf(corners);
  return std::any_of(markers_.begin(), markers_.end(), [&](const FoundMarker& found) {
    const std::array<Vec2, 4>& other = found.corners_undistorted;
    if (!Inside(other, centre) && !Inside(corners, CentreOf(other))) return false;
    return found.reading.visible_fraction >= visible ||
           MaxCornerDistance(other, corners) < kSameMarkerDistance * LongestSide(corners);
  });
}

bool FoundMarkers::Add(const SgReading& reading, DetectionPath path,
                       std::span<const Mat3> unread_borders) {
  if (ContradictsBorder(reading, unread_borders)) return false;
  // Two markers cannot be in one place: the one with the larger visible share is there.
  const std::array<Vec2, 4> corners = UndistortedSquareCorners(reading.modules_from_undistorted);
  for (FoundMarker& found : markers_) {
    const std::array<Vec2, 4>& other = found.corners_undistorted;
    if (!Inside(other, CentreOf(corners)) && !Inside(corners, CentreOf(other))) continue;
    if (reading.margin * reading.visible_fraction >
        found.reading.margin * found.reading.visible_fraction) {
      found = {reading, path, corners};
      return true;
    }
    return false;
  }
  markers_.push_back({reading, path, corners});
  return true;
}

}  // namespace pleinair::tracker
