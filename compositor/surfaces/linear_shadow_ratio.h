#pragma once

#include <array>
#include <glm/glm.hpp>

namespace pleinair::compositor {

/// The ratio by which virtual objects change a phantom's light over one triangle. It is linear
/// between the corners, because the sun lights all of the triangle or none. Pixels then need not
/// compute it from the light itself. Twin of shaders/linear_shadow_ratio.glsl, which reads it as
/// five texels in this order. Marker coordinates, metres.
struct LinearShadowRatio {
  glm::vec4 plane;  ///< Unit normal; its dot product with any point of the triangle.
  /// Red, green and blue: gradient in the triangle's plane, and the ratio at the origin.
  std::array<glm::vec4, 3> channels;
  glm::vec4 range;  ///< Min. and max. over all channels and corners; two unused values.

  static constexpr int kTexels = 5;

  /// Returns whether the ratio differs from 1 by at most `difference`.
  bool IsOne(float difference) const {
    return range.x >= 1.0F - difference && range.y <= 1.0F + difference;
  }

  /// Ratio of light with to light without objects, where objects do not shade the sun. Twin of
  /// DifferentialRatio() in shaders/differential.glsl. `sun`: sunlight on the surface that the
  /// phantoms transmit, in the unit of the ambient light.
  static glm::vec3 Between(const glm::vec3& ambient_with, const glm::vec3& ambient_without,
                           const glm::vec3& sun);

  /// Returns whether the ratio along an edge with linear light is linear, up to a hardly visible
  /// difference at the midpoint. `with` and `without`: all light at both ends, same unit.
  static bool IsLinear(const std::array<glm::vec3, 2>& with,
                       const std::array<glm::vec3, 2>& without);

  /// `ratios`: at the corners. A triangle without area gets their mean.
  static LinearShadowRatio Of(const std::array<glm::vec3, 3>& corners_m,
                              const std::array<glm::vec3, 3>& ratios);
};

}  // namespace pleinair::compositor
