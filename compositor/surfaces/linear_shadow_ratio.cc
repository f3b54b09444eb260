#include "compositor/surfaces/linear_shadow_ratio.h"

#include <algorithm>

namespace pleinair::compositor {

glm::vec3 LinearShadowRatio::Between(const glm::vec3& ambient_with,
                                     const glm::vec3& ambient_without, const glm::vec3& sun) {
  return (ambient_with + sun) / glm::max(ambient_without + sun, glm::vec3(1e-6F));
}

bool LinearShadowRatio::IsLinear(const std::array<glm::vec3, 2>& with,
                                 const std::array<glm::vec3, 2>& without) {
  constexpr float kHardlySeen = 0.004F;  // Half an 8-bit pixel value at white, less below.
  const glm::vec3 none(0.0F);
  const glm::vec3 middle = Between(with[0] + with[1], without[0] + without[1], none);
  const glm::vec3 mean =
      0.5F * (Between(with[0], without[0], none) + Between(with[1], without[1], none));
  // False if a value is NaN.
  return glm::all(glm::lessThan(glm::abs(middle - mean), glm::vec3(kHardlySeen)));
}

LinearShadowRatio LinearShadowRatio::Of(const std::array<glm::vec3, 3>& corners_m,
                                        const std::array<glm::vec3, 3>& ratios) {
  // Double precision, because large terms cancel for a small triangle far from the origin.
  const glm::dvec3 a(corners_m[0]), ab = glm::dvec3(corners_m[1]) - a,
                                    ac = glm::dvec3(corners_m[2]) - a;
  const glm::dvec3 across = glm::cross(ab, ac);
  const double area_squared = glm::dot(across, across);
  const bool has_area = area_squared > 1e-24;
  const glm::dvec3 normal = has_area ? across / glm::sqrt(area_squared) : glm::dvec3(0.0, 0.0, 1.0);
  LinearShadowRatio linear_ratio;
  linear_ratio.plane = glm::vec4(glm::vec3(normal), static_cast<float>(glm::dot(normal, a)));
  float low = ratios[0].x, high = ratios[0].x;
  for (int c = 0; c < 3; ++c) {
    const double at_a = ratios[0][c], at_b = ratios[1][c], at_c = ratios[2][c];
    // The gradient in the plane with these differences along both edges.
    const glm::dvec3 gradient =
        has_area
            ? ((at_b - at_a) * glm::cross(ac, across) + (at_c - at_a) * glm::cross(across, ab)) /
                  area_squared
            : glm::dvec3(0.0);
    const double at_origin = has_area ? at_a - glm::dot(gradient, a) : (at_a + at_b + at_c) / 3.0;
    linear_ratio.channels[c] = glm::vec4(glm::vec3(gradient), static_cast<float>(at_origin));
    for (const glm::vec3& ratio : ratios) {
      low = std::min(low, ratio[c]);
      high = std::max(high, ratio[c]);
    }
  }
  linear_ratio.range = {low, high, 0.0F, 0.0F};
  return linear_ratio;
}

}  // namespace pleinair::compositor
