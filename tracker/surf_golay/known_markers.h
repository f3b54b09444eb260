#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/block_fit.h"
#include "tracker/marker_detector.h"
#include "tracker/surf_golay/found_markers.h"

namespace pleinair::tracker {

/// A marker of the previous frames.
struct KnownMarker {
  int number = 0;
  std::array<Vec2, 4> corners_undistorted;  ///< In the last frame in which it was found,
  std::array<Vec2, 4> velocity;             ///< … and their velocity, per frame.
  bool has_velocity = false;
  double blur_px = 0.7;
  int frames_unseen = 0;
  double visible_fraction = 0.0;

  /// Predicted position in the next frame.
  BlockFitState Predict() const;
};

/// The markers of the previous frames; the same number may occur at two places.
class KnownMarkers {
 public:
  const std::vector<KnownMarker>& markers() const { return markers_; }
  /// The markers not found in the last frame.
  std::vector<LostMarker> Lost() const;
  /// Whether a known number is missing from `found`; with `at_once` only those found in one of the
  /// last few frames count.
  bool AreMissing(const std::vector<FoundMarker>& found, bool at_once) const;
  /// Updates from the markers found in a frame, and drops those not found for long.
  void Remember(const std::vector<FoundMarker>& found);

 private:
  std::vector<KnownMarker> markers_;
};

}  // namespace pleinair::tracker
