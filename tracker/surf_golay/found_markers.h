#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <span>
#include <vector>

#include "base/vector.h"
#include "tracker/observation.h"
#include "tracker/surf_golay/sg_reading.h"

namespace pleinair::tracker {

/// Of the side: two fits that ended so near to each other are one.
inline constexpr double kSameMarkerDistance = 0.04;
/// A marker of which less is observed may be a little beside: other guesses there are read as well.
inline constexpr double kSurelyVisible = 0.5;

/// A marker that was read in an image.
struct FoundMarker {
  SgReading reading;
  DetectionPath path = DetectionPath::kFast;
  std::array<Vec2, 4> corners_undistorted;
};

/// The markers found in one image, each place once.
class FoundMarkers {
 public:
  void Clear() { markers_.clear(); }
  const std::vector<FoundMarker>& markers() const { return markers_; }

  /// Keeps a reading; of two in one place only the one of which more is observed. False where the
  /// other stays, or where the border of another marker lies open there: `unread_borders`,
  /// modules from undistorted pixels.
  bool Add(const SgReading& reading, DetectionPath path, std::span<const Mat3> unread_borders);

  /// Whether a marker was found there already, of which so much is observed or that lies just so.
  bool IsTaken(const Mat3& modules_from_undistorted, double visible = 0.0) const;

 private:
  std::vector<FoundMarker> markers_;
};

}  // namespace pleinair::tracker
