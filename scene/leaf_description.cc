#include "scene/leaf_description.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pleinair::scene {

Leaf LeafAt(const LeafDescription& description, UtcTime time) {
  Leaf leaf = description.leaf;
  const std::vector<LeafStage>& stages = description.stages;
  if (stages.empty()) return leaf;
  const auto later =
      std::ranges::find_if(stages, [&](const LeafStage& stage) { return stage.date > time; });
  if (later == stages.begin() || later == stages.end()) {
    leaf.contents = later == stages.begin() ? stages.front().contents : stages.back().contents;
    return leaf;
  }
  const LeafStage& before = *(later - 1);
  const auto since = [&](UtcTime then) {
    return static_cast<double>(then.nanoseconds_since_1970()) -
           static_cast<double>(before.date.nanoseconds_since_1970());
  };
  const double share = since(time) / since(later->date);
  for (const LeafQuantity& quantity : kLeafQuantities) {
    leaf.contents.*quantity.value =
        std::lerp(before.contents.*quantity.value, later->contents.*quantity.value, share);
  }
  return leaf;
}

}  // namespace pleinair::scene
