#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "base/error.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "shadows/shadow_maps.h"

namespace pleinair::compositor {

/// Shows over a composed picture which partition of the shadow maps each surface of the scene is
/// looked up in, tinted (red, green, blue, yellow from the finest on, mixed where they fade into
/// one another), and the maps in the lower left corner, dark nearest to the sun.
class ShadowDebugView {
 public:
  /// `width`, `height`: of the render picture. Errors as gl::GlProgram::Create.
  static Result<ShadowDebugView> Create(const shadows::ShadowMapOptions& options, int width,
                                        int height);

  /// `draw_surfaces` draws all surfaces with the program given, which is in use; `positions` is
  /// RenderPositions(). Leaves `output` bound.
  void Draw(const shadows::ShadowMaps& maps, const glm::mat4& clip_from_marker,
            const std::function<void(const gl::GlProgram&)>& draw_surfaces,
            const gl::GlTexture& positions, const gl::GlFramebuffer& output) const;

 private:
  gl::GlProgram partitions_program_, tint_program_, map_program_;
  gl::GlTexture tints_, depth_;
  gl::GlFramebuffer target_;
  gl::GlVertexArray no_attributes_;
};

}  // namespace pleinair::compositor
