#include "tracker/surf_golay/image_search.h"

#include <algorithm>
#include <array>
#include <span>

#include "tracker/surf_golay/cells/decoding_confidence.h"
#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

/// A marker without a number: minimum share of its border that matches the prediction, and minimum
/// correlation of the border's single pixels. Third: its minimum lead over any other orientation.
/// In images of other prints (tests/tracker/surf_golay/sg_negative_test.cc) the correlation is at
/// most 0.41 and leads by 0.01. On markers it is 0.84 or more and leads by 0.4.
constexpr double kCertainVisible = 0.8, kCertainCorrelation = 0.6, kCertainLead = 0.2;
/// Distance of corners, in sides, beyond which two such borders are two markers.
constexpr double kOtherMarker = 0.5;

}  // namespace

void ImageSearch::SetImage(ImageView<const std::uint8_t> grey) {
  found.Clear();
  unread_by_quads = 0;
  reader.SetImage(grey);
  upright.SetImage(grey);
}

std::optional<SgReading> ImageSearch::DecodeAsGuessed(const BlockFitState& guess) {
  std::optional<SgReading> reading = reader.DecodeAsGuessed(guess);
  if (!reading) return reading;
  const double correlation = upright.Orientations(reading->corners.px)[0].correlation;
  if (!IsConfident(reading->confidence_bits, reading->visible_fraction, correlation))
    reading.reset();
  return reading;
}

std::vector<FoundMarker> ImageSearch::UnreadMarkers() {
  std::vector<FoundMarker> unread;
  const std::span<const Mat3> borders = reader.UnreadBorders();
  for (std::size_t i = 0; i < borders.size(); ++i) {
    const std::array<Vec2, 4> corners = UndistortedSquareCorners(borders[i]);
    const bool again = std::ranges::any_of(unread, [&](const FoundMarker& other) {
      return MaxCornerDistance(other.corners_undistorted, corners) <
             kOtherMarker * LongestSide(corners);
    });
    if (again || found.IsTaken(borders[i])) continue;
    const auto reading = reader.MeasureBorder({.modules_from_undistorted = borders[i]});
    if (!reading || reading->visible_fraction < kCertainVisible) continue;
    const auto [best, rival] = upright.Orientations(reading->corners.px);
    if (best.first_corner != 0 || best.mirrored || best.correlation < kCertainCorrelation ||
        best.correlation < rival.correlation + kCertainLead) {
      continue;
    }
    unread.push_back({*reading,
                      i < unread_by_quads ? DetectionPath::kFast : DetectionPath::kSurfGolay,
                      UndistortedSquareCorners(reading->modules_from_undistorted)});
  }
  return unread;
}

}  // namespace pleinair::tracker
