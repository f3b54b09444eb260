#include "compositor/ratio_pass.h"

#include <epoxy/gl.h>

namespace pleinair::compositor {

Result<RatioPass> RatioPass::Create() {
  RatioPass pass;
  PLEINAIR_ASSIGN_OR_RETURN(
      pass.id_program_, gl::GlProgram::Create({.vertex = "compositor/shaders/scene_surface.vert",
                                               .fragment = "compositor/shaders/triangle_id.frag"}));
  PLEINAIR_ASSIGN_OR_RETURN(
      pass.sort_program_,
      gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                             .fragment = "compositor/shaders/changing_pixels.frag"}));
  pass.no_attributes_ = gl::GlVertexArray::Create();
  return pass;
}

void RatioPass::DrawSurfaces(const RenderTargets& targets, const SceneSurfaces& surfaces,
                             const DrawnFrame& frame) const {
  targets.BeginSurfaces();
  id_program_.Use();
  id_program_.Set("u_clip_from_marker", frame.clip_from_marker);
  surfaces.DrawPhantoms(id_program_);
}

void RatioPass::Draw(const RenderTargets& targets, const SceneSurfaces& surfaces,
                     const SurfacePrograms& programs, const DrawnFrame& frame,
                     const Shade& shade) const {
  using Change = ChangingTriangles::Change;
  no_attributes_.Bind();
  surfaces.triangles().Bind();
  targets.BeginSorting();
  glDepthFunc(GL_ALWAYS);
  targets.ids().Bind(0);
  sort_program_.Use();
  sort_program_.Set("u_samples", targets.samples());
  glDrawArrays(GL_TRIANGLES, 0, 3);

  targets.BeginRatio();
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  // The air before a surface is seen beside the objects that cover the pixel in part.
  glEnablei(GL_BLEND, 1);
  glBlendFuncSeparatei(1, GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
  if (!frame.hazy) glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  targets.seen().Bind(0);
  for (const Change change : {Change::kSun, Change::kSunlitSky, Change::kOpenSky, Change::kSky}) {
    const gl::GlProgram& program = programs.phantoms[change];
    program.Use();
    program.Set("u_depth", DepthOf(change));
    program.Set("u_samples", static_cast<float>(targets.samples()));
    frame.Set(program);
    frame.SetRays(program);
    if (frame.hazy) frame.SetFog(program);
    if (change == Change::kSun) {
      program.Set("u_looks", shade.look ? 1.0F : 0.0F);
      program.Set("u_board_half_m", static_cast<float>(shade.board_m / 2));
      frame.SetSunlight(program);
    }
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisablei(GL_BLEND, 1);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
}

}  // namespace pleinair::compositor
