#pragma once

#include <list>
#include <optional>
#include <vector>

#include "base/image.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "shadows/bench/bench_scene.h"
#include "shadows/shadow_maps.h"

namespace pleinair::shadows {

/// What a method made of a view: visibility and depth of view, row 0 at the top; depth 0 where
/// there is no surface.
struct VisibilityPicture {
  Image<float> visibility;
  Image<float> depth_m;
};

/// Milliseconds of one frame, the renderer's work finished: the least of several frames, because
/// what else the machine does only ever adds.
struct FrameTime {
  double maps_ms = 0.0;   ///< All maps drawn anew.
  double scene_ms = 0.0;  ///< Depth first, then the visibility of what is seen.
  double cpu_ms = 0.0;    ///< Processor time of both, all threads: what a software renderer costs
                          ///< whatever else the machine does.
  double total_ms() const { return maps_ms + scene_ms; }
};

/// Points origin + (column + ½) du + (row + ½) dv on a plane.
struct ProbeGrid {
  glm::dvec3 origin{0.0}, du{0.0}, dv{0.0}, normal{0.0, 0.0, 1.0};
  int width = 0, height = 0;

  glm::dvec3 At(int x, int y) const { return origin + du * (x + 0.5) + dv * (y + 0.5); }
};

/// Draws one scene with any shadow method, one sample a pixel in its middle or several as the
/// compositor does, so that edges of surfaces do not tremble where its camera creeps. Needs a
/// current GL context for its whole life.
class BenchRenderer {
 public:
  static Result<BenchRenderer> Create(const BenchScene& scene, int width, int height,
                                      int samples = 1);

  /// The method from now on. Errors as ShadowMaps::Create.
  Result<void> SetMethod(const ShadowMapOptions& options);

  /// The view with its near and far moved to what is seen (the paper's first step), in steps of 2^⅛
  /// so that a creeping camera does not change them in every frame.
  Result<View> Tightened(const View& view);

  /// Draws a view; maps are redrawn where they must be. `redrawn`, where given, counts them.
  Result<VisibilityPicture> Draw(const View& view, int* redrawn = nullptr);

  /// In place of visibility, the number of the partition that a point is looked up in (between two
  /// where they fade into one another), −1 for none.
  Result<VisibilityPicture> DrawPartitions(const View& view);

  /// Times `frames` frames of a view.
  Result<FrameTime> Time(const View& view, int frames);

  /// Visibility at the points of a grid, from the maps as last drawn.
  Result<std::vector<float>> Probe(const ProbeGrid& grid);

  const ShadowMaps& maps() const { return maps_.front(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  struct Surface {
    gl::GlBuffer positions, indices;
    gl::GlVertexArray vertices;
    int index_count = 0;
  };
  struct Scene {
    glm::dvec3 to_sun{0.0};
    std::list<Surface> surfaces;
    std::vector<ShadowCaster> casters;
  };
  struct Programs {
    gl::GlProgram depth, view, partitions, probe;
  };
  /// Visibility and depth of view, and the depth buffer.
  struct Target {
    gl::GlTexture picture, depth;
    gl::GlFramebuffer framebuffer;
  };
  Result<int> UpdateMaps(const View& view);
  void DrawSurfaces(const gl::GlProgram& program, const View& view);
  const gl::GlFramebuffer& DrawTarget() const {
    return samples_target_ ? samples_target_->framebuffer : target_.framebuffer;
  }
  void DrawDepth(const gl::GlFramebuffer& target, const View& view);
  void DrawVisible(const gl::GlProgram& program, const View& view);
  VisibilityPicture Read() const;

  int width_ = 0, height_ = 0;
  Scene scene_;
  std::vector<ShadowMaps> maps_;  // One; none before SetMethod.
  Programs programs_;
  Target target_;
  std::optional<Target> samples_target_;  // With several samples a pixel.
  gl::GlVertexArray no_vertices_;
};

}  // namespace pleinair::shadows
