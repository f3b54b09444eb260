#include "compositor/passes/object_pass.h"

#include <epoxy/gl.h>

#include <string>
#include <utility>
#include <vector>

#include "compositor/passes/shadow_ratio_pass.h"

namespace pleinair::compositor {

Result<ObjectPass> ObjectPass::Create(bool detailed, bool by_places) {
  ObjectPass pass;
  const auto with_details = [&](std::vector<std::string> defines) {
    if (detailed) defines.emplace_back("DETAILED");
    if (by_places) defines.emplace_back("BY_PLACES");
    return defines;
  };
  for (const bool behind : {false, true}) {
    const auto create = [&](std::vector<std::string> defines) {
      defines.emplace_back("OBJECT");
      if (behind) defines.emplace_back("BEHIND");
      return gl::GlProgram::Create({.vertex = "compositor/shaders/scene_surface.vert",
                                    .fragment = "compositor/shaders/triangle_id.frag",
                                    .defines = std::move(defines)});
    };
    IdPrograms& ids = behind ? pass.behind_ids_ : pass.ids_;
    PLEINAIR_ASSIGN_OR_RETURN(ids.plain, create({}));
    PLEINAIR_ASSIGN_OR_RETURN(ids.textured, create(with_details({"TEXTURED"})));
    PLEINAIR_ASSIGN_OR_RETURN(ids.alpha, create(with_details({"TEXTURED", "ALPHA"})));
  }
  PLEINAIR_ASSIGN_OR_RETURN(
      pass.sort_program_,
      gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                             .fragment = "compositor/shaders/object_pixels.frag"}));
  pass.no_attributes_ = gl::GlVertexArray::Create();
  return pass;
}

void ObjectPass::DrawSurfaces(const RenderTargets& targets, const SceneSurfaces& surfaces,
                              const FrameUniforms& frame, const PixelRect& within) const {
  const bool textured = surfaces.materials().HasTextures();
  const IdPrograms& ids = frame.place.behind.dioptres == nullptr ? ids_ : behind_ids_;
  const gl::GlProgram& id_program = surfaces.materials().HasAlpha() ? ids.alpha
                                    : textured                      ? ids.textured
                                                                    : ids.plain;
  targets.BeginObjectIds(textured);
  glEnable(GL_SCISSOR_TEST);
  glScissor(within.x, within.y, within.width, within.height);
  id_program.Use();
  id_program.Set("u_samples", targets.samples());
  id_program.Set("u_place_side", frame.place.side);
  id_program.Set("u_place", frame.place.number);
  id_program.Set("u_places", frame.place.count);
  frame.DrawSides(id_program, [&] { surfaces.DrawObjects(id_program); });
  glDisable(GL_SCISSOR_TEST);
}

void ObjectPass::Draw(const RenderTargets& targets, const SceneSurfaces& surfaces,
                      const CoveragePass& coverage, const SurfacePrograms& programs,
                      const FrameUniforms& frame, const gl::GlTexture& environment,
                      std::span<const PixelRect> within) const {
  no_attributes_.Bind();
  surfaces.object_triangles().Bind();
  surfaces.object_materials().Bind(2);
  targets.BeginSorting();
  glDepthFunc(GL_ALWAYS);
  targets.ids().Bind(0);
  sort_program_.Use();
  sort_program_.Set("u_samples", targets.samples());
  sort_program_.Set("u_eye_m", frame.eye_m);
  frame.SetRays(sort_program_);
  DrawWithin(within);
  coverage.DrawOver(true, targets.samples());

  targets.BeginObjects();
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  targets.seen().Bind(0);
  targets.weights().Bind(19);
  environment.Bind(3);
  targets.texels().Bind(4);
  if (surfaces.materials().HasDetails()) {
    targets.gradients().Bind(16);
    targets.emissions().Bind(17);
  }
  // Same values as KindOf() in shaders/visibility_buffer_layout.glsl for triangles of objects.
  for (int kind = 0; kind < 2; ++kind) {
    const gl::GlProgram& program = kind == 0 ? programs.objects : programs.objects_in_own_shade;
    program.Use();
    program.Set("u_depth", ShadowRatioPass::DepthOf(static_cast<AffectedTriangles::Change>(kind)));
    program.Set("u_samples", static_cast<float>(targets.samples()));
    frame.Set(program);
    frame.SetRays(program);
    frame.SetFog(program);
    frame.SetEnvironment(program);
    frame.SetSunTransmittance(program);
    DrawWithin(within);
  }
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
}

}  // namespace pleinair::compositor
