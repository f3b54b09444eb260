#pragma once

#include <array>
#include <glm/glm.hpp>

namespace pleinair::compositor {

/// The ratio that virtual objects change a phantom's light by, over one of its triangles on which
/// the sun is either everywhere or nowhere: linear from corner to corner, so that pixels need not
/// work it out from the light itself. Twin of shaders/linear_shadow_ratio.glsl, which takes it as
/// five texels in this order. Marker coordinates, metres.
struct LinearShadowRatio {
  glm::vec4 plane;  ///< Unit normal; its dot product with a place of the triangle.
  /// Red, green and blue: gradient along the triangle, and the ratio at the origin.
  std::array<glm::vec4, 3> channels;
  glm::vec4 range;  ///< Least and most of all channels' corners; two that are not used.

  static constexpr int kTexels = 5;

  /// Twin of DifferentialRatio() in shaders/differential.glsl where objects take nothing of `sun`,
  /// what phantoms leave of it on the surface; same unit as the sky's and bounced light with and
  /// without the objects.
  static glm::vec3 Between(const glm::vec3& ambient_with, const glm::vec3& ambient_without,
                           const glm::vec3& sun);

  /// Whether the ratio of lights that are linear along an edge is linear itself, but for what is
  /// hardly seen: its middle tells. `with` and `without`: all light at both ends, same unit.
  static bool IsLinear(const std::array<glm::vec3, 2>& with,
                       const std::array<glm::vec3, 2>& without);

  /// `ratios`: at the corners. Of a triangle without an area, their mean.
  static LinearShadowRatio Of(const std::array<glm::vec3, 3>& corners_m,
                              const std::array<glm::vec3, 3>& ratios);
};

}  // namespace pleinair::compositor
