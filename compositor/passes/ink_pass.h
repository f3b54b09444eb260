#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/ink/ink_grid.h"
#include "compositor/ink/ink_shape.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/ink_images.h"
#include "compositor/passes/render_targets.h"
#include "compositor/passes/shadow_ratio_pass.h"
#include "compositor/surfaces/image_tiles.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "shadows/light_window.h"
#include "shadows/shadow_maps.h"

namespace pleinair::compositor {

/// Draws ink onto the real surfaces: for each pixel, its place on them and what ink covers there,
/// in closed form. Nothing is drawn as geometry, so that ink neither flickers nor ends beside its
/// surface. Needs a current OpenGL context; move-only.
class InkPass {
 public:
  InkPass() = default;

  /// Replaces all ink; the first shape is the lowest. `marker_from_map`: the rotation from east,
  /// north, up to the marker's axes. Errors (system): no memory.
  Result<void> SetShapes(std::span<const InkShape> shapes, const Mat3& marker_from_map);
  bool empty() const { return grid_.empty(); }

  /// Tiles of an image that ink may touch. `image`: with clip_from_position for marker coordinates.
  /// `bounds`: of the real surfaces, marker coordinates.
  ImageTiles TilesOf(SceneProjection image, const shadows::Box& bounds) const;

  /// The camera's picture, seen from the render image.
  struct Picture {
    float blur_px = 0.0F;            ///< Blur to add, render pixels, standard deviation.
    float render_px = 1.0F;          ///< Render pixels of a camera pixel.
    shadows::ShadowMapOptions maps;  ///< Bound, for paint.
    bool fades = false;              ///< SceneShadows::Fades().
  };
  /// Draws into `images`, within their tiles. Requires the state of ShadowRatioPass::Draw().
  /// Errors: as gl::GlProgram::Create.
  Result<void> Draw(const RenderTargets& targets, const SceneSurfaces& surfaces,
                    const ShadowRatioPass& ratio, const FrameUniforms& frame,
                    const ShadowRatioPass::ShadowOptions& shadows, const Picture& picture,
                    const InkImages& images);

  /// Lets go of programs, for other shadow maps.
  void ClearPrograms() { programs_ = {}; }

 private:
  /// What the shapes have, for the choice of a program.
  struct Content {
    bool areas = false, paint = false;
    float widest_px = 0.0F;
  };
  struct Tables {
    gl::GlTexture cells, entries, parts, segments, shapes;
  };
  Result<void> Upload(std::span<const InkShape> shapes);
  Result<const gl::GlProgram*> ProgramFor(const Picture& picture);
  void SetLevels(const gl::GlProgram& program) const;

  InkGrid grid_;
  Mat3 marker_from_map_;
  Content content_;
  Tables tables_;
  std::array<std::optional<gl::GlProgram>, 2> programs_;  // Without and with fading shadows.
  gl::GlVertexArray no_attributes_;
};

}  // namespace pleinair::compositor
