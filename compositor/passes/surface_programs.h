#pragma once

#include <array>

#include "base/error.h"
#include "compositor/surfaces/affected_triangles.h"
#include "gl/program.h"
#include "shadows/shadow_maps.h"

namespace pleinair::compositor {

/// The programs that shade a scene's surfaces, of one permutation.
struct SurfacePrograms {
  struct Permutation {
    bool fades = false;           ///< The sun stands between two steps, FadingShadowMaps::Fades().
    bool needs_airlight = false;  ///< The air before the real surfaces counts.
    bool textured = false;        ///< Some of the objects have textures,
    bool glossy = false;          ///< and some mirror their surroundings.
  };
  /// Errors as gl::GlProgram::Create.
  static Result<SurfacePrograms> Create(const shadows::ShadowMapOptions& options,
                                        const Permutation& permutation);

  /// By what may change of the light: AffectedTriangles::kSun and kSunlitSky.
  std::array<gl::GlProgram, AffectedTriangles::kLinearSky> phantoms;
  gl::GlProgram objects;               ///< Where the sun may shine on some of a pixel, and
  gl::GlProgram objects_in_own_shade;  ///< where it does not.
};

}  // namespace pleinair::compositor
