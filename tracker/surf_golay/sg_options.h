#pragma once

#include <vector>

namespace pleinair::tracker {

/// How S-G markers are looked for.
enum class SgStrategy {
  kHybrid,     ///< Quadrilaterals first; keypoints and cells for what they miss.
  kFast,       ///< Quadrilaterals alone: the whole outer edge must be observed.
  kSurfGolay,  ///< Keypoints of the border, and corners of cells where these find nothing.
};

/// How S-G markers are detected.
struct SgOptions {
  SgStrategy strategy = SgStrategy::kHybrid;
  /// Numbers that are in use, if they are known: others are not reported, and more cells of these
  /// may be covered. None given: all 4,096.
  std::vector<int> numbers_in_use;
};

}  // namespace pleinair::tracker
