#include <algorithm>
#include <cmath>

#include "compositor/models/animation/model_animation.h"
#include "compositor/models/placed_model.h"

namespace pleinair::compositor {

double Playback::MomentAt(double scene_s) const {
  const double duration_s = animation->duration_s();
  const double moment_s = start_s + scene_s;
  if (!loop) return std::clamp(moment_s, 0.0, duration_s);
  return moment_s - duration_s * std::floor(moment_s / duration_s);
}

ModelBounds BoundsOfShapes(const PlacedModel& placed) {
  const ModelBounds bounds = placed.playback.animation->bounds();
  ModelBounds box{{1e30, 1e30, 1e30}, {-1e30, -1e30, -1e30}};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at = placed.linear * Vec3{(corner & 1) != 0 ? bounds.min_m.x : bounds.max_m.x,
                                         (corner & 2) != 0 ? bounds.min_m.y : bounds.max_m.y,
                                         (corner & 4) != 0 ? bounds.min_m.z : bounds.max_m.z} +
                    placed.translation_m;
    box.min_m = {std::min(box.min_m.x, at.x), std::min(box.min_m.y, at.y),
                 std::min(box.min_m.z, at.z)};
    box.max_m = {std::max(box.max_m.x, at.x), std::max(box.max_m.y, at.y),
                 std::max(box.max_m.z, at.z)};
  }
  return box;
}

}  // namespace pleinair::compositor
