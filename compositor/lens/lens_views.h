#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/image.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/render_targets.h"
#include "compositor/surfaces/image_tiles.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "shadows/light_window.h"

namespace pleinair::compositor {

/// Views of a scene that count equally in their mean.
struct AveragedViews {
  shadows::View planes;  ///< Its near and far planes are those of all.
  std::vector<FrameUniforms> frames;
};

/// Where the objects of an image are, per pixel: the mean over the views.
struct ObjectDistances {
  Image<float> dioptres;  ///< 1/z, 1/m, where they have a share.
  Image<float> share;     ///< Part of the views and of the pixel's samples, 0…1.
};

/// Weight of a view. All are 1 / count but for rounding to multiples of 2⁻²⁰, whose sums are exact:
/// pixels that no view changes keep their bytes.
float WeightOfView(std::size_t view, std::size_t count);

/// Draws the virtual image from many places, one after another, and averages the linear light. Many
/// places on a lens's stop, or of a moving camera, give what it sees in all, with what its parts
/// hide from one another. Needs a current OpenGL context; move-only.
class LensViews {
 public:
  /// Draws a scene as a frame shows it.
  using DrawFrame = std::function<void(const FrameUniforms&)>;

  LensViews() = default;
  /// For render targets of this size. Errors as gl::GlTexture::Create2D() and
  /// gl::GlProgram::Create().
  static Result<LensViews> Create(int width, int height);

  /// Calls `draw` for each view. It has to draw targets.ratio() and targets.objects(),
  /// which have the means afterwards. `within`: all pixels drawn, in disjoint rectangles.
  void Draw(const RenderTargets& targets, const AveragedViews& views,
            std::span<const PixelRect> within, const DrawFrame& draw) const;

  /// Where the objects of the last Draw() are.
  ObjectDistances Distances() const;

  /// Measures what covers objects at these distances. `draw_real` has to draw the real surfaces
  /// alone. Returns whether real surfaces cover objects in a part of the views in any pixel.
  /// occluder_share() then has the share of each pixel.
  bool MeasureOccluders(const RenderTargets& targets, const AveragedViews& views,
                        std::span<const PixelRect> within, const ObjectDistances& objects,
                        const DrawFrame& draw_real);
  /// Share of the views that shows a real surface in front of the objects, one channel.
  const gl::GlTexture& occluder_share() const { return sums_.share; }

 private:
  using BindInputs = std::function<void()>;
  /// Draws each view by `draw`, and adds what `program` makes of it to `sums`. `bind`: the inputs
  /// of `program` besides the depth.
  void AddViews(const RenderTargets& targets, const AveragedViews& views,
                std::span<const PixelRect> within, const DrawFrame& draw,
                const gl::GlFramebuffer& sums, const gl::GlProgram& program,
                const BindInputs& bind) const;

  struct Sums {
    gl::GlTexture ratio, objects, distance, share;
    gl::GlFramebuffer pictures, occluders;
  };
  struct Programs {
    gl::GlProgram view, copy, occluders;
  };

  Sums sums_;
  gl::GlTexture virtual_;
  Programs programs_;
  gl::GlVertexArray no_attributes_;
};

}  // namespace pleinair::compositor
