#pragma once

#include <array>

#include "base/error.h"
#include "compositor/surfaces/affected_triangles.h"
#include "gl/program.h"
#include "shadows/shadow_maps.h"

namespace pleinair::compositor {

/// Programs that shade a scene's surfaces, in one permutation.
struct SurfacePrograms {
  struct Permutation {
    bool fades = false;           ///< The sun lies between two steps, FadingShadowMaps::Fades().
    bool needs_airlight = false;  ///< The airlight in front of the real surfaces is noticeable.
    bool textured = false;        ///< Some objects have textures.
    bool blended = false;         ///< SceneMaterials::HasBlended().
    bool detailed = false;        ///< SceneMaterials::HasDetails().
    bool translucent = false;     ///< SceneMaterials::HasTranslucent().
    bool glossy = false;          ///< Some objects are glossy.
  };
  /// Errors as gl::GlProgram::Create.
  static Result<SurfacePrograms> Create(const shadows::ShadowMapOptions& options,
                                        const Permutation& permutation);

  /// By the change of light: AffectedTriangles::kSun and kSunlitSky.
  std::array<gl::GlProgram, AffectedTriangles::kLinearSky> phantoms;
  gl::GlProgram objects;               ///< Where the sun may reach a part of a pixel.
  gl::GlProgram objects_in_own_shade;  ///< Where the sun does not reach the pixel.
};

}  // namespace pleinair::compositor
