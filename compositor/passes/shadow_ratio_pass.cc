#include "compositor/passes/shadow_ratio_pass.h"

#include <epoxy/gl.h>

namespace pleinair::compositor {

Result<ShadowRatioPass> ShadowRatioPass::Create(bool blended) {
  ShadowRatioPass pass;
  PLEINAIR_ASSIGN_OR_RETURN(
      pass.id_program_, gl::GlProgram::Create({.vertex = "compositor/shaders/scene_surface.vert",
                                               .fragment = "compositor/shaders/triangle_id.frag"}));
  PLEINAIR_ASSIGN_OR_RETURN(
      pass.behind_id_program_,
      gl::GlProgram::Create({.vertex = "compositor/shaders/scene_surface.vert",
                             .fragment = "compositor/shaders/triangle_id.frag",
                             .defines = {"BEHIND"}}));
  PLEINAIR_ASSIGN_OR_RETURN(
      pass.sort_program_,
      gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                             .fragment = "compositor/shaders/affected_pixels.frag"}));
  gl::ProgramStages linear_ratio{.vertex = "compositor/shaders/screen_triangle.vert",
                                 .fragment = "compositor/shaders/linear_shadow_ratio.frag"};
  if (blended) linear_ratio.defines.emplace_back("BLENDED");
  PLEINAIR_ASSIGN_OR_RETURN(pass.linear_program_, gl::GlProgram::Create(linear_ratio));
  linear_ratio.defines.emplace_back("AIRLIGHT");
  PLEINAIR_ASSIGN_OR_RETURN(pass.linear_program_with_airlight_,
                            gl::GlProgram::Create(linear_ratio));
  pass.no_attributes_ = gl::GlVertexArray::Create();
  return pass;
}

void ShadowRatioPass::DrawSurfaces(const RenderTargets& targets, const SceneSurfaces& surfaces,
                                   const FrameUniforms& frame, const PixelRect& within) const {
  DrawIds(targets, surfaces, frame, within, SceneSurfaces::Numbered::kAffected);
}

void ShadowRatioPass::DrawAllSurfaces(const RenderTargets& targets, const SceneSurfaces& surfaces,
                                      const FrameUniforms& frame, const PixelRect& within) const {
  DrawIds(targets, surfaces, frame, within, SceneSurfaces::Numbered::kAll);
}

void ShadowRatioPass::DrawIds(const RenderTargets& targets, const SceneSurfaces& surfaces,
                              const FrameUniforms& frame, const PixelRect& within,
                              SceneSurfaces::Numbered numbered) const {
  targets.BeginSurfaces();
  glEnable(GL_SCISSOR_TEST);
  glScissor(within.x, within.y, within.width, within.height);
  const gl::GlProgram& program =
      frame.place.behind.dioptres == nullptr ? id_program_ : behind_id_program_;
  program.Use();
  frame.DrawSides(program, [&] { surfaces.DrawPhantoms(program, numbered); });
  glDisable(GL_SCISSOR_TEST);
}

void ShadowRatioPass::Begin(const RenderTargets& targets, const SceneSurfaces& surfaces,
                            const CoveragePass& coverage, std::span<const PixelRect> within) const {
  no_attributes_.Bind();
  surfaces.triangles().Bind();
  targets.BeginSorting();
  glDepthFunc(GL_ALWAYS);
  targets.ids().Bind(0);
  sort_program_.Use();
  sort_program_.Set("u_samples", targets.samples());
  DrawWithin(within);
  coverage.DrawOver(false, targets.samples());

  targets.BeginRatio(within);
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  targets.seen().Bind(0);
  targets.weights().Bind(19);
  if (targets.sample_weights()) targets.sample_weights().Bind(18);
}

void ShadowRatioPass::Shade(const FrameUniforms& frame, const gl::GlProgram& program,
                            AffectedTriangles::Change change, bool needs_airlight,
                            std::span<const PixelRect> within) const {
  program.Use();
  program.Set("u_depth", DepthOf(change));
  frame.Set(program);
  frame.SetRays(program);
  if (needs_airlight) frame.SetFog(program);
  DrawWithin(within);
}

void ShadowRatioPass::DrawSky(const RenderTargets& targets, const SceneSurfaces& surfaces,
                              const SurfacePrograms& programs, const FrameUniforms& frame,
                              const PixelRect& within) const {
  const std::span<const PixelRect> whole(&within, 1);
  Begin(targets, surfaces, CoveragePass(), whole);
  surfaces.triangles().BindLinearRatios();
  Shade(frame, linear_program_, AffectedTriangles::kLinearSky, false, whole);
  if (!frame.needs_airlight) {
    surfaces.triangles().Bind();
    const auto change = AffectedTriangles::kSunlitSky;
    Shade(frame, programs.phantoms[change], change, false, whole);
  }
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
}

void ShadowRatioPass::Draw(const RenderTargets& targets, const SceneSurfaces& surfaces,
                           const CoveragePass& coverage, const SurfacePrograms& programs,
                           const FrameUniforms& frame, const ShadowOptions& options,
                           std::span<const PixelRect> within) const {
  using Change = AffectedTriangles::Change;
  Begin(targets, surfaces, coverage, within);
  const auto draw_linear = [&](const gl::GlProgram& program, bool needs_airlight) {
    surfaces.triangles().BindLinearRatios();
    Shade(frame, program, Change::kLinearSky, needs_airlight, within);
    surfaces.triangles().Bind();
  };
  if (!frame.linear_needs_airlight) draw_linear(linear_program_, false);
  if (frame.needs_airlight) {
    // The airlight in front of a surface is visible beside objects that cover a part of the pixel.
    targets.BeginAirlight();
    glEnablei(GL_BLEND, 1);
    glBlendFuncSeparatei(1, GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
  }
  const gl::GlProgram& sun = programs.phantoms[Change::kSun];
  sun.Set("u_assumes_unmodelled_shadows", options.assume_unmodelled ? 1.0F : 0.0F);
  sun.Set("u_margin_half_m", static_cast<float>(options.margin_size_m / 2));
  for (const Change change : {Change::kSun, Change::kSunlitSky}) {
    frame.SetSunTransmittance(programs.phantoms[change]);
    Shade(frame, programs.phantoms[change], change, frame.needs_airlight, within);
  }
  if (frame.linear_needs_airlight) draw_linear(linear_program_with_airlight_, true);
  if (frame.needs_airlight) glDisablei(GL_BLEND, 1);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
}

void EnableSurfaceTests() {
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glFrontFace(GL_CW);
}

}  // namespace pleinair::compositor
