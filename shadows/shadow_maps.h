#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/frames.h"
#include "base/image.h"
#include "base/units.h"
#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "shadows/caster_edges.h"
#include "shadows/changing_depth.h"
#include "shadows/depth_bounds.h"
#include "shadows/depth_raster.h"
#include "shadows/edge_map.h"
#include "shadows/light_window.h"
#include "shadows/shadow_map_options.h"
#include "shadows/shadow_method.h"
#include "shadows/shadow_uniforms.h"

namespace pleinair::shadows {

/// A shadow caster: indexed triangles with positions (vec3) at input 0 and 32-bit indices. Every
/// receiver must be a caster too, phantoms included.
struct ShadowCaster {
  const gl::GlVertexArray* vertices = nullptr;
  int index_count = 0;
  glm::dmat4 marker_from_model{1.0};
  Box bounds;                  ///< Marker coordinates; must contain all triangles.
  std::uint64_t revision = 0;  ///< Change it when the content of the buffers changes.
  /// Draws only the triangles that run counter-clockwise as seen from the sun: half of a closed
  /// body. Its other sides, and the backs of open surfaces, must be casters of their own.
  bool sun_side_only = false;
  /// The same triangles in memory, of a caster whose shape often changes. Depth maps draw them in
  /// place of `vertices`, on the processor and with the sun's side only (depth_raster.h); a new
  /// shape then redraws nothing else. The memory must outlive its use. Empty: not used.
  TriangleSpan triangles;
  /// Its edges, of a caster without `triangles`. Narrow penumbrae then end where it does, and not
  /// at whole texels. They belong to `revision`, and must outlive the caster's use.
  std::span<const CasterEdge> edges = {};
};

/// Z-partitioned shadow maps of the sun (Kolivand & Sunar 2014, with the deviations explained in
/// docs/method/shadows.md). Each partition has a depth map along the sun's rays and the data of the
/// chosen visibility method (a pyramid of depth bounds, or blurred moments). Maps are redrawn only
/// when casters, windows or the sun change; FadingShadowMaps follows a moving sun without jumps.
/// Needs a current GL context; move-only.
///
///     auto maps = ShadowMaps::Create({});
///     maps->UpdateForRegion(casters, to_sun, bounds_of_virtual_objects);
///     maps->Bind(0);  // then draw with a shader that includes shadow_visibility.glsl
class ShadowMaps {
 public:
  /// Errors: options out of range (kInput); out of memory or shader compilation failed (kSystem).
  static Result<ShadowMaps> Create(const ShadowMapOptions& options);

  /// Fits the partitions to a camera's view (Eq. 11), as in the paper. Returns the number of
  /// redrawn maps. Both Update functions leave the default framebuffer bound and the depth test
  /// enabled. Errors (kInput): no sun direction, view depths out of order.
  Result<int> UpdateForView(std::span<const ShadowCaster> casters, Direction<Marker> to_sun,
                            const View& view);

  /// Fits the finest map to `focus` (usually the virtual objects), the last to all casters. The
  /// result does not depend on the camera, so that a recording with a static scene draws its maps
  /// once. All points that the virtual objects shade or are shaded by lie inside the finest map.
  /// With two sets of maps (with and without the virtual objects), the visibilities therefore
  /// differ only there.
  Result<int> UpdateForRegion(std::span<const ShadowCaster> casters, Direction<Marker> to_sun,
                              const Box& focus);

  /// Redraws all maps at the next update (measurements).
  void Invalidate() {
    for (Slice& slice : slices_) slice.drawn = {};
  }

  /// Binds the maps as set number `set` of shadow_visibility.glsl: uniform block
  /// kUniformBlockBinding + set, texture units kTextureUnit + 2 set and the next.
  void Bind(int set) const;

  /// Binds the depth array, 0…1 per partition, to a texture unit (debug views).
  void BindDepth(int unit) const { depth_.Bind(unit); }

  /// Weight of these maps in a cross-fade with another step's, for SHADOW_CROSS_FADE.
  void SetShare(double share);

  /// Shader defines for `sets` sets of maps with these options.
  static std::vector<std::string> ShaderDefines(const ShadowMapOptions& options, int sets);

  /// Depths of one partition, 0 nearest to the sun, 1 where nothing was drawn; row 0 at the lowest
  /// v (debug views). Blocks until the renderer has finished.
  Image<float> ReadDepth(int partition) const;

  const ShadowMapOptions& options() const { return options_; }
  const ShadowUniforms& uniforms() const { return uniforms_; }

 private:
  // Everything that determines a map's content.
  struct CasterKey {
    GLuint vertices = 0;
    int index_count = 0;
    glm::dmat4 marker_from_model{1.0};
    std::uint64_t revision = 0;
    bool sun_side_only = false;
    const CasterEdge* edges = nullptr;
    bool operator==(const CasterKey&) const = default;
  };
  struct SliceKey {
    LightWindow window;
    double depth_min = 0.0, depth_max = 0.0;
    glm::dvec3 to_sun{0.0};
    std::vector<CasterKey> casters;
    bool operator==(const SliceKey&) const = default;
  };
  struct Slice {
    SliceKey drawn;
    gl::GlFramebuffer depth_target;
    std::vector<gl::GlFramebuffer> bounds_targets;  // One per level of the pyramid.
    ChangingDepth changing;                         // Not in `drawn`.
    DepthBounds changing_bounds;
    gl::GlFramebuffer moments_target;
  };

  // Moment methods: intermediate buffer between the two passes.
  struct BlurBuffer {
    gl::GlTexture texture;
    gl::GlFramebuffer target;
  };

  struct Programs {
    gl::GlProgram depth;
    gl::GlProgram first;   // Depth to bounds, or to moments blurred along u.
    gl::GlProgram second;  // Bounds to bounds, or moments blurred along v.
  };

  ShadowMaps() = default;
  MapContent Content() const { return ContentOf(options_); }
  bool UsesMoments() const {
    return Content() == MapContent::kMoments || Content() == MapContent::kWarpedMoments;
  }
  Result<void> CreateMoments(int size);
  Result<void> CreateBounds(int size);
  Result<int> Redraw(std::span<const ShadowCaster> casters, const LightAxes& axes,
                     const std::vector<LightWindow>& windows, double blend_band);
  /// Minimum and maximum depth of a map.
  std::pair<double, double> DepthRange(const LightWindow& window, const LightExtent& scene) const;
  void DrawDepth(int slice, const LightAxes& axes);
  void DrawBounds(int slice);
  void DrawMoments(int slice);

  ShadowMapOptions options_;
  ShadowUniforms uniforms_{};
  gl::GlBuffer uniform_buffer_;
  gl::GlTexture depth_;    // Array of partitions, 0…1 over the depth range.
  gl::GlTexture bounds_;   // Pyramid of minimum and maximum depth, from a quarter of the size down.
  gl::GlTexture moments_;  // Moment methods.
  EdgeMap edges_;          // For the finest map; the sun's disc.
  BlurBuffer blur_;
  gl::GlVertexArray no_vertices_;
  Programs programs_;
  std::vector<Slice> slices_;
};

}  // namespace pleinair::shadows
