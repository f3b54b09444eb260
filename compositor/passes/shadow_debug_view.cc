#include "compositor/passes/shadow_debug_view.h"

#include <algorithm>
#include <utility>

namespace pleinair::compositor {

Result<ShadowDebugView> ShadowDebugView::Create(const shadows::ShadowMapOptions& options, int width,
                                                int height) {
  ShadowDebugView view;
  PLEINAIR_ASSIGN_OR_RETURN(
      view.partitions_program_,
      gl::GlProgram::Create({.vertex = "compositor/shaders/scene_surface.vert",
                             .fragment = "compositor/shaders/shadow_partitions.frag",
                             .defines = shadows::ShadowMaps::ShaderDefines(options, 1)}));
  PLEINAIR_ASSIGN_OR_RETURN(
      view.tint_program_,
      gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                             .fragment = "compositor/shaders/shadow_tint.frag"}));
  PLEINAIR_ASSIGN_OR_RETURN(
      view.map_program_, gl::GlProgram::Create({.vertex = "compositor/shaders/screen_triangle.vert",
                                                .fragment = "compositor/shaders/shadow_map.frag"}));
  PLEINAIR_ASSIGN_OR_RETURN(view.tints_, gl::GlTexture::Create2D(GL_RGBA8, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(view.depth_,
                            gl::GlTexture::Create2D(GL_DEPTH_COMPONENT32F, width, height));
  PLEINAIR_ASSIGN_OR_RETURN(view.target_,
                            gl::GlFramebuffer::Create({.colors = {{.texture = &view.tints_}},
                                                       .depth = {.texture = &view.depth_}}));
  view.no_attributes_ = gl::GlVertexArray::Create();
  return view;
}

void ShadowDebugView::Draw(const shadows::ShadowMaps& maps, const glm::mat4& clip_from_marker,
                           const std::function<void(const gl::GlProgram&)>& draw_surfaces,
                           const gl::GlTexture& positions, const gl::GlFramebuffer& output) const {
  target_.Bind();
  target_.ClearColor(0, 1, 1, 1, 1);
  target_.ClearDepth(1.0F);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  maps.Bind(0);
  partitions_program_.Use();
  partitions_program_.Set("u_clip_from_marker", clip_from_marker);
  draw_surfaces(partitions_program_);
  glDisable(GL_DEPTH_TEST);

  output.Bind();
  no_attributes_.Bind();
  glEnable(GL_BLEND);
  glBlendFunc(GL_ZERO, GL_SRC_COLOR);
  tint_program_.Use();
  tints_.Bind(0);
  positions.Bind(1);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);

  // Each map's area is in proportion to its texels.
  map_program_.Use();
  maps.BindDepth(0);
  const shadows::ShadowMapOptions& options = maps.options();
  const int maximum = *std::max_element(options.resolutions.begin(),
                                        options.resolutions.begin() + options.partitions);
  const int gap = std::max(output.height() / 100, 1);
  int left = gap;
  for (int i = 0; i < options.partitions; ++i) {
    const int side = std::max(output.height() / 4 * options.resolutions[i] / maximum, 1);
    // Row 0 of the image is its top.
    glViewport(left, output.height() - gap - side, side, side);
    map_program_.Set("u_slice", i);
    map_program_.Set("u_origin_px", glm::vec2(left, output.height() - gap - side));
    map_program_.Set("u_texels_px", static_cast<float>(options.resolutions[i]) / side);
    map_program_.Set("u_texels", options.resolutions[i]);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    left += side + gap;
  }
  output.Bind();
}

}  // namespace pleinair::compositor
