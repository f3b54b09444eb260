#include "tracker/surf/keypoint_selection.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

#include "tests/tracker/surf/surf_test_images.h"
#include "tracker/surf/surf.h"

namespace pleinair::tracker {
namespace {

TEST(KeypointSelection, KeepsWhatTheRuleOfFairSharesSays) {
  const GreyImage image = TestTexture(3, 150).Draw(300, 260, 0, 1);
  std::vector<SurfKeypoint> all;
  Surf({.max_keypoints = 100000, .bucket_px = 0}).Detect(image.view(), &all);
  ASSERT_GT(all.size(), 40u);
  constexpr int kBucket_px = 80;
  for (const std::size_t most : {std::size_t{0}, std::size_t{5}, all.size() / 3, all.size() - 1}) {
    // Ranks within buckets, the strongest first; every rank below `share` fits.
    std::map<std::pair<int, int>, int> counts;
    std::vector<int> ranks;
    std::map<int, std::size_t> with_rank;
    for (const SurfKeypoint& k : all) {
      ranks.push_back(
          counts[{static_cast<int>(k.x) / kBucket_px, static_cast<int>(k.y) / kBucket_px}]++);
      ++with_rank[ranks.back()];
    }
    std::size_t kept = 0;
    int share = 0;
    while (kept + with_rank[share] <= most) kept += with_rank[share++];
    std::vector<SurfKeypoint> expected;
    std::size_t left_over = most - kept;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool fits = ranks[i] < share;
      if (fits || left_over > 0) expected.push_back(all[i]);
      left_over -= !fits && left_over > 0;
    }
    std::vector<SurfKeypoint> selected(all.rbegin(), all.rend());
    KeypointSelection().KeepFairShares(300, 260, kBucket_px, static_cast<int>(most), &selected);
    ASSERT_EQ(selected.size(), most);
    for (std::size_t i = 0; i < most; ++i) {
      EXPECT_EQ(selected[i].x, expected[i].x) << i;
      EXPECT_EQ(selected[i].y, expected[i].y) << i;
    }
  }
}

}  // namespace
}  // namespace pleinair::tracker
