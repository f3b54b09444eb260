#include <algorithm>
#include <cmath>

#include "compositor/models/animation/model_animation.h"

namespace pleinair::compositor {

double Playback::MomentAt(double scene_s) const {
  const double duration_s = animation->duration_s();
  const double moment_s = start_s + scene_s;
  if (!loop) return std::clamp(moment_s, 0.0, duration_s);
  return moment_s - duration_s * std::floor(moment_s / duration_s);
}

}  // namespace pleinair::compositor
