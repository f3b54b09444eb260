#pragma once

#include <vector>

#include "base/utc_time.h"
#include "compositor/composer.h"
#include "compositor/models/placed_model.h"

namespace pleinair::session {

/// Gives the animated models of a scene their shape at `time`. The scene's time starts at `begin`.
/// `placed`: the models of the composer.
void PlayAnimations(const std::vector<compositor::PlacedModel>& placed, UtcTime begin, UtcTime time,
                    compositor::Composer* composer);

}  // namespace pleinair::session
