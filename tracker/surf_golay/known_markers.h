#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <vector>

#include "base/vector.h"
#include "tracker/alignment/block_fit.h"
#include "tracker/marker_detector.h"
#include "tracker/surf_golay/found_markers.h"

namespace pleinair::tracker {

/// A marker of the frames before.
struct KnownMarker {
  int number = 0;
  std::array<Vec2, 4> corners_undistorted;  ///< In the last frame that saw it,
  std::array<Vec2, 4> velocity;             ///< … and their motion, per frame.
  bool has_velocity = false;
  double blur_px = 0.7;
  int frames_unseen = 0;
  double visible_fraction = 0.0;

  /// Where it should be in the next frame.
  BlockFitState Predict() const;
};

/// The markers of the frames before, of which some may hang in two places.
class KnownMarkers {
 public:
  const std::vector<KnownMarker>& markers() const { return markers_; }
  /// Those not seen in the last frame.
  std::vector<LostMarker> Lost() const;
  /// Whether a number is not among what was found; with `at_once` only of those seen in one of the
  /// last few frames.
  bool AreMissing(const std::vector<FoundMarker>& found, bool at_once) const;
  /// Takes over what was found in a frame, and forgets what was not seen for long.
  void Remember(const std::vector<FoundMarker>& found);

 private:
  std::vector<KnownMarker> markers_;
};

}  // namespace pleinair::tracker
