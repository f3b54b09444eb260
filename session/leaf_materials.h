#pragma once

#include <vector>

#include "base/error.h"
#include "base/utc_time.h"
#include "compositor/models/placed_model.h"
#include "scene/leaf_description.h"

namespace pleinair::session {

/// Replaces the materials of virtual objects by the leaves that name them, with the contents of
/// `time`; of several leaves that fit, the last counts. Phantoms stay. Errors (input): a name or
/// pattern that fits no material; maps that cannot be read.
Result<void> ReplaceByLeaves(const std::vector<scene::LeafDescription>& leaves, UtcTime time,
                             std::vector<compositor::PlacedModel>* placed);

}  // namespace pleinair::session
