#include "compositor/passes/shadow_ratio_pass.h"

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
  gl::ProgramStages steady{.vertex = "compositor/shaders/screen_triangle.vert",
                           .fragment = "compositor/shaders/steady_ratio.frag"};
  PLEINAIR_ASSIGN_OR_RETURN(pass.steady_program_, gl::GlProgram::Create(steady));
  steady.defines = {"HAZE"};
  PLEINAIR_ASSIGN_OR_RETURN(pass.steady_program_in_haze_, gl::GlProgram::Create(steady));
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
  targets.seen().Bind(0);
  const auto draw = [&](const gl::GlProgram& program, Change change, bool hazy) {
    program.Use();
    program.Set("u_depth", DepthOf(change));
    program.Set("u_samples", static_cast<float>(targets.samples()));
    frame.Set(program);
    frame.SetRays(program);
    if (hazy) frame.SetFog(program);
    if (change == Change::kSun) {
      program.Set("u_looks", shade.look ? 1.0F : 0.0F);
      program.Set("u_board_half_m", static_cast<float>(shade.board_m / 2));
      frame.SetSunlight(program);
    }
    glDrawArrays(GL_TRIANGLES, 0, 3);
  };
  const auto draw_steady = [&](const gl::GlProgram& program, bool hazy) {
    surfaces.triangles().BindSteady();
    draw(program, Change::kSteadySky, hazy);
    surfaces.triangles().Bind();
  };
  if (!frame.steady_hazy) draw_steady(steady_program_, false);
  if (frame.hazy) {
    // The air before a surface is seen beside the objects that cover the pixel in part.
    targets.BeginHaze();
    glEnablei(GL_BLEND, 1);
    glBlendFuncSeparatei(1, GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
  }
  for (const Change change : {Change::kSun, Change::kSunlitSky}) {
    draw(programs.phantoms[change], change, frame.hazy);
  }
  if (frame.steady_hazy) draw_steady(steady_program_in_haze_, true);
  if (frame.hazy) glDisablei(GL_BLEND, 1);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
}

}  // namespace pleinair::compositor
