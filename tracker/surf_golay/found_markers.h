#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <span>
#include <vector>

#include "base/vector.h"
#include "tracker/observation.h"
#include "tracker/surf_golay/sg_reading.h"

namespace pleinair::tracker {

/// Share of the side: two fits that end closer than this are the same marker.
inline constexpr double kSameMarkerDistance = 0.04;
/// A marker with a smaller visible share may be misplaced: other hypotheses there are decoded too.
inline constexpr double kSurelyVisible = 0.5;

/// A marker that was decoded in an image.
struct FoundMarker {
  SgReading reading;
  DetectionPath path = DetectionPath::kFast;
  std::array<Vec2, 4> corners_undistorted;
};

/// The markers found in one image, one per place.
class FoundMarkers {
 public:
  void Clear() { markers_.clear(); }
  const std::vector<FoundMarker>& markers() const { return markers_; }

  /// Adds a reading; of two at one place the one with the larger visible share is kept. Returns
  /// false if the other one is kept, or if an unoccluded border of another marker lies there:
  /// `unread_borders`, modules from undistorted pixels.
  bool Add(const SgReading& reading, DetectionPath path, std::span<const Mat3> unread_borders);

  /// Whether a marker was already found there with at least this visible share, or in exactly this
  /// position.
  bool IsTaken(const Mat3& modules_from_undistorted, double visible = 0.0) const;

 private:
  std::vector<FoundMarker> markers_;
};

}  // namespace pleinair::tracker
