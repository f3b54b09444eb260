#include "shadows/sun_steps.h"

#include <cmath>

namespace pleinair::shadows {
namespace {

// Position of p between a and b, 0…1, projected onto the line through them.
double ShareOf(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 way = b - a;
  return glm::dot(p - a, way) / glm::dot(way, way);
}

}  // namespace

void SunSteps::Restart(const glm::dvec3& to_sun) {
  step_ = {to_sun, to_sun, 0.0};
  started_ = true;
}

void SunSteps::Aim(const glm::dvec3& from_here, const glm::dvec3& towards) {
  step_.from = from_here;
  // For a small angle the chord equals the angle.
  step_.to = glm::normalize(from_here + step_rad_ * glm::normalize(towards - from_here));
}

const SunStep& SunSteps::Follow(const glm::dvec3& to_sun) {
  const glm::dvec3 motion = to_sun - last_;
  const double moved = glm::length(motion);
  last_ = to_sun;
  if (!started_ || moved > step_rad_) {
    Restart(to_sun);
    return step_;
  }
  if (moved == 0.0) return step_;
  if (step_.from == step_.to) {
    Aim(step_.from, to_sun);
  } else {
    const double share = ShareOf(to_sun, step_.from, step_.to);
    if (share > 1.0) Aim(step_.to, to_sun + step_rad_ / moved * motion);
    if (share < 0.0) Aim(step_.from, to_sun);
  }
  step_.share = ShareOf(to_sun, step_.from, step_.to);
  const double astray = glm::distance(to_sun, step_.from + step_.share * (step_.to - step_.from));
  if (!(step_.share >= 0.0 && step_.share <= 1.0 && astray < 0.25 * step_rad_)) Restart(to_sun);
  return step_;
}

}  // namespace pleinair::shadows
