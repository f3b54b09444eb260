#include <algorithm>

#include "compositor/light/changing/changing_bodies.h"

namespace pleinair::compositor {

Result<std::unique_ptr<ChangingBodies>> ChangingBodies::Create(
    const std::vector<PlacedModel>& scene) {
  if (std::ranges::none_of(
          scene, [](const PlacedModel& placed) { return placed.playback.animation != nullptr; })) {
    return nullptr;
  }
  return SystemError("pleinair", "was built without Embree, which animations need",
                     "install libembree-dev and build it again");
}

}  // namespace pleinair::compositor
