#include "tracker/surf/keypoint_selection.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace pleinair::tracker {

void KeypointSelection::KeepFairShares(int width, int height, int bucket_px, int max_keypoints,
                                       std::vector<SurfKeypoint>* keypoints) {
  // Position and scale decide between equals, so that the order does not depend on how they came.
  std::sort(keypoints->begin(), keypoints->end(), [](const SurfKeypoint& a, const SurfKeypoint& b) {
    return std::tie(b.response, a.y, a.x, a.scale) < std::tie(a.response, b.y, b.x, b.scale);
  });
  const std::size_t limit = static_cast<std::size_t>(std::max(max_keypoints, 0));
  if (keypoints->size() <= limit) return;
  if (bucket_px <= 0) {
    keypoints->resize(limit);
    return;
  }

  // Rank of each keypoint within its bucket, and how many have each rank.
  const int columns = (width - 1) / bucket_px + 1;
  const int rows = (height - 1) / bucket_px + 1;
  bucket_counts_.assign(static_cast<std::size_t>(columns) * rows, 0);
  ranks_.resize(keypoints->size());
  with_rank_.assign(keypoints->size(), 0);
  for (std::size_t i = 0; i < keypoints->size(); ++i) {
    const SurfKeypoint& keypoint = (*keypoints)[i];
    const int column = std::clamp(static_cast<int>(keypoint.x) / bucket_px, 0, columns - 1);
    const int row = std::clamp(static_cast<int>(keypoint.y) / bucket_px, 0, rows - 1);
    ranks_[i] = bucket_counts_[static_cast<std::size_t>(row) * columns + column]++;
    ++with_rank_[ranks_[i]];
  }
  // Every rank below `share` fits.
  std::size_t kept = 0;
  int share = 0;
  while (kept + with_rank_[share] <= limit) kept += with_rank_[share++];
  std::size_t left_over = limit - kept;
  std::size_t count = 0;
  for (std::size_t i = 0; i < keypoints->size(); ++i) {
    bool keep = ranks_[i] < share;
    if (!keep && left_over > 0) {
      keep = true;
      --left_over;
    }
    if (keep) (*keypoints)[count++] = (*keypoints)[i];
  }
  keypoints->resize(count);
}

}  // namespace pleinair::tracker
