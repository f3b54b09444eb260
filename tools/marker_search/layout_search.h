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
  /// How many views may be rendered and scored, all layouts together. The result depends on this
  /// and on the seed, not on how fast the machine is.
  long budget = 100'000;
  /// Begin with one layout instead of with random ones.
  std::optional<BorderLayout> start;
};

struct ScoredLayout {
  BorderLayout layout;
  double score = 0.0;
};

/// Draws many layouts, scores them on few views, keeps the best, and improves those by one change
/// after another; the number of those that are improved is halved as it goes on. Returns the last
/// ones, best first by all of `scorer`'s views. `progress` gets a line now and then.
std::vector<ScoredLayout> SearchLayouts(LayoutScorer* scorer, const LayoutSearchOptions& options,
                                        const std::function<void(const std::string&)>& progress);

}  // namespace pleinair::marker_search
