#include "tracker/surf/keypoint_selection.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace pleinair::tracker {
namespace {

/// Position and scale decide between equal responses, so that the result does not depend on the
/// input's order.
bool IsStronger(const SurfKeypoint& a, const SurfKeypoint& b) {
  return std::tie(b.response, a.y, a.x, a.scale) < std::tie(a.response, b.y, b.x, b.scale);
}

}  // namespace

// Textured images have twenty times as many keypoints as are kept: only the kept ones are sorted.
void KeypointSelection::KeepFairShares(int width, int height, int bucket_px, int max_keypoints,
                                       std::vector<SurfKeypoint>* keypoints) {
  const auto limit = static_cast<std::ptrdiff_t>(std::max(max_keypoints, 0));
  const auto strongest = [](std::vector<SurfKeypoint>* of, std::ptrdiff_t count) {
    std::nth_element(of->begin(), of->begin() + count, of->end(), IsStronger);
  };
  if (std::ssize(*keypoints) > limit) {
    if (bucket_px <= 0) {
      strongest(keypoints, limit);
      keypoints->resize(static_cast<std::size_t>(limit));
    } else {
      PartByBuckets(width, height, bucket_px, *keypoints);
      // All keypoints of a rank below `share` fit.
      std::ptrdiff_t kept = 0, share = 0;
      while (kept + with_rank_[share] <= limit) kept += with_rank_[share++];
      keypoints->clear();
      rest_.clear();
      auto begin = by_bucket_.begin();
      for (const std::int32_t bucket_end : bucket_ends_) {
        const auto end = by_bucket_.begin() + bucket_end;
        const auto middle = begin + std::min(share, end - begin);
        if (middle != end) std::nth_element(begin, middle, end, IsStronger);
        keypoints->insert(keypoints->end(), begin, middle);
        rest_.insert(rest_.end(), middle, end);
        begin = end;
      }
      strongest(&rest_, limit - kept);
      keypoints->insert(keypoints->end(), rest_.begin(), rest_.begin() + (limit - kept));
    }
  }
  std::sort(keypoints->begin(), keypoints->end(), IsStronger);
}

void KeypointSelection::PartByBuckets(int width, int height, int bucket_px,
                                      const std::vector<SurfKeypoint>& keypoints) {
  const int columns = (width - 1) / bucket_px + 1;
  const int rows = (height - 1) / bucket_px + 1;
  // Counts first, then the start of each bucket, which advances to its end as the bucket is filled.
  bucket_ends_.assign(static_cast<std::size_t>(columns) * rows, 0);
  bucket_of_.resize(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const int column = std::clamp(static_cast<int>(keypoints[i].x) / bucket_px, 0, columns - 1);
    const int row = std::clamp(static_cast<int>(keypoints[i].y) / bucket_px, 0, rows - 1);
    bucket_of_[i] = row * columns + column;
    ++bucket_ends_[bucket_of_[i]];
  }
  const std::int32_t most = *std::ranges::max_element(bucket_ends_);
  with_rank_.assign(static_cast<std::size_t>(most) + 1, 0);
  std::int32_t begin = 0;
  for (std::int32_t& bucket : bucket_ends_) {
    const std::int32_t count = bucket;
    for (std::int32_t rank = 0; rank < count; ++rank) ++with_rank_[rank];
    bucket = begin;
    begin += count;
  }
  by_bucket_.resize(keypoints.size());
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    by_bucket_[bucket_ends_[bucket_of_[i]]++] = keypoints[i];
  }
}

}  // namespace pleinair::tracker
