#pragma once

#include <glm/glm.hpp>

namespace pleinair::shadows {

/// Where the sun stands between two directions that shadow maps are drawn for.
struct SunStep {
  glm::dvec3 from{0.0}, to{0.0};  ///< Unit; the same while the sun has not moved.
  double share = 0.0;             ///< 0 at `from`, 1 at `to`.
};

/// Cuts the sun's way into steps, so that maps stay as they are while it moves from one to the next
/// and their shadows are mixed: their texels do not crawl, and nothing jumps. The next step is
/// taken ahead of the sun, in the direction of its last motion; it lies on the sun's way to within
/// the way's curvature over one step (less than 10⁻⁴ of a step of 0.05°).
class SunSteps {
 public:
  explicit SunSteps(double step_rad) : step_rad_(step_rad) {}

  /// `to_sun`: unit. A sun that leaps by more than a step (another hour, a film of a day) or turns
  /// off its way starts anew where it stands: such shadows do jump.
  const SunStep& Follow(const glm::dvec3& to_sun);

 private:
  void Restart(const glm::dvec3& to_sun);
  /// Steps on from `from_here` so that the way leads through what lies ahead of the sun.
  void Aim(const glm::dvec3& from_here, const glm::dvec3& towards);

  double step_rad_;
  bool started_ = false;
  SunStep step_;
  glm::dvec3 last_{0.0};
};

}  // namespace pleinair::shadows
