#pragma once

#include <array>

#include "base/error.h"
#include "compositor/changing_triangles.h"
#include "gl/program.h"
#include "shadows/shadow_maps.h"

namespace pleinair::compositor {

/// The programs that shade a scene's surfaces, of one permutation.
struct SurfacePrograms {
  /// `fades`: the sun stands between two steps, FadingShadowMaps::Fades(); `hazy`: the air before
  /// the real surfaces counts; `textured`: some of the objects have textures. Errors as
  /// gl::GlProgram::Create.
  static Result<SurfacePrograms> Create(const shadows::ShadowMapOptions& options, bool fades,
                                        bool hazy, bool textured);

  /// By what may change of the light: ChangingTriangles::Change but for kNothing.
  std::array<gl::GlProgram, ChangingTriangles::kNothing> phantoms;
  gl::GlProgram objects;               ///< Where the sun may shine on some of a pixel, and
  gl::GlProgram objects_in_own_shade;  ///< where it does not.
};

}  // namespace pleinair::compositor
