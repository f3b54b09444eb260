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

/// Debug view over a composed image. It tints each surface by its shadow map partition: red, green,
/// blue, yellow from the finest on, mixed where partitions fade into one another. It shows the maps
/// in the lower left corner, where dark is nearest to the sun.
class ShadowDebugView {
 public:
  /// `width` and `height` are those of the render image. Errors as gl::GlProgram::Create.
  static Result<ShadowDebugView> Create(const shadows::ShadowMapOptions& options, int width,
                                        int height);

  /// `draw_surfaces` draws all surfaces with the given program, which is in use. `positions` is
  /// RenderPositions(). `output` is bound afterwards.
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
