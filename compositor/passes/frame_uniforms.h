#pragma once

#include <array>
#include <glm/glm.hpp>

#include "compositor/passes/aerial_fog.h"
#include "gl/program.h"

namespace pleinair::compositor {

/// What the programs that shade surfaces are told of one frame. Marker coordinates, metres.
struct DrawnFrame {
  glm::mat4 clip_from_marker{1.0F};
  glm::vec3 eye_m{0.0F};
  std::array<glm::vec3, 3> ray{};  ///< RaysThroughPixels().
  glm::vec3 gain{0.0F};            ///< Display-linear value per radiance.
  glm::vec3 to_sun{0.0F};          ///< Unit; zero without a sun.
  glm::vec3 sun_normal_lux{0.0F};
  std::array<glm::vec4, 2> texture_from_marker{};  ///< Of SeenSunlight's map.
  FogSplits fog;
  bool hazy = false;         ///< The air before the farthest real surface is noticed,
  bool steady_hazy = false;  ///< and where only the sky's light changes, steadily.

  /// Eye, gain and sun, which all of them are told.
  void Set(const gl::GlProgram& program) const;
  /// For shaders/seen_surface.glsl.
  void SetRays(const gl::GlProgram& program) const;
  void SetFog(const gl::GlProgram& program) const;
  /// For shaders/seen_sunlight.glsl.
  void SetSunlight(const gl::GlProgram& program) const;
};

}  // namespace pleinair::compositor
