#pragma once

#include <vector>

namespace pleinair::tracker {

/// Search strategy for S-G markers.
enum class SgStrategy {
  kHybrid,     ///< Quadrilaterals first; keypoints and cells for the rest.
  kFast,       ///< Quadrilaterals only: the whole outer edge must be visible.
  kSurfGolay,  ///< Keypoints of the border, then corners of cells if these find nothing.
};

/// Options of the S-G detector.
struct SgOptions {
  SgStrategy strategy = SgStrategy::kHybrid;
  /// Numbers in use, if known: others are not reported, and more cells of these may be occluded.
  /// Empty: all 4,096.
  std::vector<int> numbers_in_use;
};

}  // namespace pleinair::tracker
