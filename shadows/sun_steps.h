#pragma once

#include <glm/glm.hpp>

namespace pleinair::shadows {

/// Position of the sun between two directions for which shadow maps are drawn.
struct SunStep {
  glm::dvec3 from{0.0}, to{0.0};  ///< Unit vectors; equal until the sun has moved.
  double share = 0.0;             ///< 0 at `from`, 1 at `to`.
};

/// Divides the sun's path into steps. Maps stay unchanged while the sun moves from one step to the
/// next, and their shadows are cross-faded, so that texels do not crawl and shadows do not jump.
/// The next step is predicted from the sun's last motion; its error is the curvature of the path
/// over one step (less than 10⁻⁴ of a step of 0.05°).
class SunSteps {
 public:
  explicit SunSteps(double step_rad) : step_rad_(step_rad) {}

  /// `to_sun`: unit vector. If the sun moves by more than a step at once (another hour, a time
  /// lapse) or leaves its path, the steps restart at its position; these shadows do jump.
  const SunStep& Follow(const glm::dvec3& to_sun);

 private:
  void Restart(const glm::dvec3& to_sun);
  /// Steps on from `from_here` so that the path leads through `towards`, ahead of the sun.
  void Aim(const glm::dvec3& from_here, const glm::dvec3& towards);

  double step_rad_;
  bool started_ = false;
  SunStep step_;
  glm::dvec3 last_{0.0};
};

}  // namespace pleinair::shadows
