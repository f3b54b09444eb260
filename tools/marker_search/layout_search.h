#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/marker_search/border_layout.h"
#include "tools/marker_search/layout_score.h"

namespace pleinair::marker_search {

struct LayoutSearchOptions {
  std::uint64_t seed = 1;
  /// Number of views to render and score, over all layouts. The result depends on the budget and
  /// the seed, not on the machine's speed.
  long budget = 100'000;
  /// Initial layout; random layouts if unset.
  std::optional<BorderLayout> start;
};

struct ScoredLayout {
  BorderLayout layout;
  double score = 0.0;
};

/// Draws random layouts, scores them on a few views and improves the best ones by single changes.
/// The number of layouts under improvement is halved repeatedly. Returns the last ones, best first
/// by all of `scorer`'s views. `progress` receives a status line from time to time.
std::vector<ScoredLayout> SearchLayouts(LayoutScorer* scorer, const LayoutSearchOptions& options,
                                        const std::function<void(const std::string&)>& progress);

}  // namespace pleinair::marker_search
