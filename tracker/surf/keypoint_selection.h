#pragma once
// Internal: between the .cc files of this module; not installed.

#include <cstdint>
#include <vector>

#include "tracker/surf/surf_keypoint.h"

namespace pleinair::tracker {

/// Keeps at most `max_keypoints`, strongest first. Where there are more, every bucket of
/// `bucket_px` px keeps its strongest up to one number common to all, so that a busy background
/// does not use up the keypoints; what is left over goes to the strongest of the rest. Without
/// buckets (`bucket_px` <= 0) simply the strongest.
class KeypointSelection {
 public:
  void KeepFairShares(int width, int height, int bucket_px, int max_keypoints,
                      std::vector<SurfKeypoint>* keypoints);

 private:
  /// Fills by_bucket_, and with_rank_: how many buckets have a keypoint of each rank.
  void PartByBuckets(int width, int height, int bucket_px,
                     const std::vector<SurfKeypoint>& keypoints);

  std::vector<std::int32_t> bucket_of_;
  std::vector<std::int32_t> bucket_ends_;  ///< In by_bucket_.
  std::vector<std::int32_t> with_rank_;
  std::vector<SurfKeypoint> by_bucket_, rest_;
};

}  // namespace pleinair::tracker
