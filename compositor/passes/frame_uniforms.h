#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>

#include "compositor/passes/aerial_fog.h"
#include "gl/program.h"
#include "gl/texture.h"

namespace pleinair::compositor {

/// How a frame changes the environment that glossy surfaces mirror.
struct EnvironmentMix {
  glm::vec3 sky_mix{1.0F};    ///< Strength of the sky.
  glm::vec3 below_mix{1.0F};  ///< Strength of the light from below the horizon.
  glm::vec3 up{0.0F, 0.0F, 1.0F};
};

/// What a frame leaves out, so that it shows what lies behind. Both sides of the rest are drawn, as
/// the far side of a body covers what is behind it, too.
struct BehindNearest {
  /// 1/z, 1/m, one channel: each pixel's nearest surface that is drawn. 0: none is. Null: all are.
  const gl::GlTexture* dioptres = nullptr;
  float near_dioptres = 0.0F, far_dioptres = 0.0F;  ///< The view's planes.
};

/// The part of a pixel that is drawn.
struct PixelPlace {
  float side = 1.0F;          ///< Side of the square that the place stands for, pixels.
  int number = 0, count = 1;  ///< Among the places drawn one after another.
  BehindNearest behind;       ///< Depths that are left out.
};

/// Per-frame uniforms of the programs that shade surfaces. Marker coordinates, metres.
struct FrameUniforms {
  glm::mat4 clip_from_marker{1.0F};
  glm::vec3 eye_m{0.0F};
  std::array<glm::vec3, 3> ray{};  ///< RaysThroughPixels().
  glm::vec3 exposure_scale{0.0F};  ///< Display-linear value per radiance.
  glm::vec3 to_sun{0.0F};          ///< Unit; zero without a sun.
  glm::vec3 sun_normal_lux{0.0F};
  PixelPlace place;
  EnvironmentMix environment;
  /// For the maps of SunShade: trees, clouds.
  std::array<std::array<glm::vec4, 2>, 2> shade_from_marker{};
  FogSplits fog;
  /// The airlight in front of the farthest real surface is noticeable.
  bool needs_airlight = false;
  /// The airlight is noticeable where the shadow ratio is linear.
  bool linear_needs_airlight = false;

  /// Returns whether light in front of a surface changes a pixel by half a value at black.
  bool IsNoticed(const glm::vec3& airlight) const;

  /// The frame as seen through the place at `offset_px` from each pixel's center, one of `count`.
  /// `size_px`: of the image. Each place stands for its share of the pixel.
  FrameUniforms SeenThrough(glm::vec2 offset_px, glm::vec2 size_px, int number, int count) const;

  /// Sets the uniforms common to all programs: eye, exposure scale and sun.
  void Set(const gl::GlProgram& program) const;
  /// Calls `draw` for the sides of surfaces that are drawn into triangle numbers. `program`: in
  /// use, of shaders/triangle_id.frag, with BEHIND where surfaces are left out. Requires
  /// EnableSurfaceTests().
  void DrawSides(const gl::GlProgram& program, const std::function<void()>& draw) const;
  /// For shaders/visible_surface.glsl.
  void SetRays(const gl::GlProgram& program) const;
  void SetFog(const gl::GlProgram& program) const;
  /// For the mirrored environment of shaders/virtual_object.frag.
  void SetEnvironment(const gl::GlProgram& program) const;
  /// For shaders/sun_transmittance_map.glsl.
  void SetSunTransmittance(const gl::GlProgram& program) const;
};

}  // namespace pleinair::compositor
