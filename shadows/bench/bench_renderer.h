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

/// Result of a method for one view: visibility and view depth, row 0 at the top; depth 0 where
/// there is no surface.
struct VisibilityPicture {
  Image<float> visibility;
  Image<float> depth_m;
};

/// Milliseconds of one frame until the renderer has finished. The minimum of several frames,
/// because other load on the machine only adds time.
struct FrameTime {
  double maps_ms = 0.0;   ///< All maps redrawn.
  double scene_ms = 0.0;  ///< Depth pass, then visibility of the visible surfaces.
  double cpu_ms = 0.0;    ///< Processor time of both, all threads: the cost of a software renderer,
                          ///< independent of other load.
  double total_ms() const { return maps_ms + scene_ms; }
};

/// Sample points origin + (column + ½) du + (row + ½) dv on a plane.
struct ProbeGrid {
  glm::dvec3 origin{0.0}, du{0.0}, dv{0.0}, normal{0.0, 0.0, 1.0};
  int width = 0, height = 0;

  glm::dvec3 At(int x, int y) const { return origin + du * (x + 0.5) + dv * (y + 0.5); }
};

/// Renders one scene with any shadow method. Takes one sample per pixel at its centre, or several
/// as the compositor does, which keeps edges stable under slow camera motion. A GL context must be
/// current during its whole lifetime.
class BenchRenderer {
 public:
  static Result<BenchRenderer> Create(const BenchScene& scene, int width, int height,
                                      int samples = 1);

  /// Sets the method. Errors as ShadowMaps::Create().
  Result<void> SetMethod(const ShadowMapOptions& options);

  /// The view with near and far tightened to the visible surfaces (the paper's first step). They
  /// change in steps of 2^⅛, so that a slow camera does not change them in every frame.
  Result<View> Tightened(const View& view);

  /// Renders a view, redrawing maps where needed. `redrawn`, if given, receives their number.
  Result<VisibilityPicture> Draw(const View& view, int* redrawn = nullptr);

  /// As Draw(), with the partition index of each point in place of visibility (fractional where two
  /// partitions blend), −1 for none.
  Result<VisibilityPicture> DrawPartitions(const View& view);

  /// Measures the time over `frames` frames of a view.
  Result<FrameTime> Time(const View& view, int frames);

  /// Visibility at the points of a grid, from the last maps.
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
  /// Visibility and view depth, and the depth buffer.
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
  std::vector<ShadowMaps> maps_;  // One; empty before SetMethod().
  Programs programs_;
  Target target_;
  std::optional<Target> samples_target_;  // With several samples per pixel.
  gl::GlVertexArray no_vertices_;
};

}  // namespace pleinair::shadows
