#pragma once

#include <array>
#include <glm/glm.hpp>

#include "compositor/passes/aerial_fog.h"
#include "gl/program.h"

namespace pleinair::compositor {

/// What the programs that shade surfaces are told of one frame. Marker coordinates, metres.
struct FrameUniforms {
  glm::mat4 clip_from_marker{1.0F};
  glm::vec3 eye_m{0.0F};
  std::array<glm::vec3, 3> ray{};  ///< RaysThroughPixels().
  glm::vec3 exposure_scale{0.0F};  ///< Display-linear value per radiance.
  glm::vec3 to_sun{0.0F};          ///< Unit; zero without a sun.
  glm::vec3 sun_normal_lux{0.0F};
  std::array<glm::vec4, 2> texture_from_marker{};  ///< Of SunTransmittanceMap's map.
  FogSplits fog;
  bool needs_airlight = false;         ///< The air before the farthest real surface is noticed,
  bool linear_needs_airlight = false;  ///< and where only the sky's light changes, steadily.

  /// Eye, exposure scale and sun, which all of them are told.
  void Set(const gl::GlProgram& program) const;
  /// For shaders/visible_surface.glsl.
  void SetRays(const gl::GlProgram& program) const;
  void SetFog(const gl::GlProgram& program) const;
  /// For shaders/sun_transmittance_map.glsl.
  void SetSunTransmittance(const gl::GlProgram& program) const;
};

}  // namespace pleinair::compositor
