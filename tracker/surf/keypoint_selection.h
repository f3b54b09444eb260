#pragma once
// Internal: shared by the .cc files of this module; not installed.

#include <cstdint>
#include <vector>

#include "tracker/surf/surf_keypoint.h"

namespace pleinair::tracker {

/// Keeps at most `max_keypoints`, strongest first. If there are more, each square bucket of
/// `bucket_px` px keeps its strongest, up to a number common to all buckets, so that a detailed
/// background does not use up all keypoints; the remainder goes to the strongest of the rest.
/// Without buckets (`bucket_px` <= 0) the strongest are kept.
class KeypointSelection {
 public:
  void KeepFairShares(int width, int height, int bucket_px, int max_keypoints,
                      std::vector<SurfKeypoint>* keypoints);

 private:
  /// Fills by_bucket_, and with_rank_: the number of buckets that have a keypoint of each rank.
  void PartByBuckets(int width, int height, int bucket_px,
                     const std::vector<SurfKeypoint>& keypoints);

  std::vector<std::int32_t> bucket_of_;
  std::vector<std::int32_t> bucket_ends_;  ///< End of each bucket in by_bucket_.
  std::vector<std::int32_t> with_rank_;
  std::vector<SurfKeypoint> by_bucket_, rest_;
};

}  // namespace pleinair::tracker
