#include "tracker/surf_golay/known_markers.h"

#include <algorithm>

#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

/// Frames after which a marker that is not observed is forgotten; first frames in which its border
/// is searched for each time. After these the search is occasional.
constexpr int kForgetAfter = 90, kSearchAtOnce = 5;

}  // namespace

BlockFitState KnownMarker::Predict() const {
  std::array<Vec2, 4> corners = corners_undistorted;
  if (has_velocity && frames_unseen == 0) {
    for (int i = 0; i < 4; ++i) corners[i] = corners[i] + velocity[i];
  }
  BlockFitState state;
  state.modules_from_undistorted = ModulesFromSquareCorners(corners);
  state.blur_px = blur_px;
  return state;
}

std::vector<LostMarker> KnownMarkers::Lost() const {
  std::vector<LostMarker> lost;
  for (const KnownMarker& known : markers_) {
    if (known.frames_unseen > 0) lost.push_back({"sg", known.number, known.frames_unseen});
  }
  return lost;
}

bool KnownMarkers::AreMissing(const std::vector<FoundMarker>& found, bool at_once) const {
  return std::any_of(markers_.begin(), markers_.end(), [&](const KnownMarker& known) {
    return (!at_once || known.frames_unseen < kSearchAtOnce) &&
           std::none_of(found.begin(), found.end(), [&](const FoundMarker& marker) {
             return marker.reading.number == known.number;
           });
  });
}

void KnownMarkers::Remember(const std::vector<FoundMarker>& found) {
  for (KnownMarker& known : markers_) ++known.frames_unseen;
  for (const FoundMarker& marker : found) {
    const SgReading& reading = marker.reading;
    const std::array<Vec2, 4> corners = UndistortedSquareCorners(reading.modules_from_undistorted);
    // The nearest marker of its number: a number may be in two places.
    KnownMarker* same = nullptr;
    for (KnownMarker& known : markers_) {
      if (known.number != reading.number || known.frames_unseen == 0) continue;
      if (same == nullptr || MaxCornerDistance(known.corners_undistorted, corners) <
                                 MaxCornerDistance(same->corners_undistorted, corners)) {
        same = &known;
      }
    }
    if (same == nullptr) {
      markers_.push_back(
          {reading.number, corners, {}, false, reading.blur_px, 0, reading.visible_fraction});
      continue;
    }
    same->has_velocity = same->frames_unseen == 1;
    for (int i = 0; i < 4; ++i) same->velocity[i] = corners[i] - same->corners_undistorted[i];
    same->corners_undistorted = corners;
    same->blur_px = reading.blur_px;
    same->visible_fraction = reading.visible_fraction;
    same->frames_unseen = 0;
  }
  std::erase_if(markers_,
                [](const KnownMarker& known) { return known.frames_unseen > kForgetAfter; });
}

}  // namespace pleinair::tracker
