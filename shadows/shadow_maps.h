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
#include "shadows/light_window.h"
#include "shadows/shadow_method.h"
#include "shadows/shadow_uniforms.h"

namespace pleinair::shadows {

/// Angular radius of the sun's disc at its mean distance: half of 0.533°.
constexpr Radians kSunAngularRadius = FromDegrees(0.2665);

struct ShadowMapOptions {
  ShadowMethod method = ShadowMethod::kSunDisc;
  SunDiscFilter sun_disc_filter = SunDiscFilter::kFull;
  int partitions = 2;         ///< 1 to 4.
  double split_weight = 0.5;  ///< λ of Eq. 11.
  /// 16…8192 texels a side; powers of two where the maps have a pyramid
  /// (MapContent::kDepthBounds).
  std::array<int, kMaxPartitions> resolutions{2048, 2048, 1024, 1024};
  Radians sun_angular_radius = kSunAngularRadius;
  /// Moment methods: distance of the blocker at which the blur has the disc's width.
  Metres blur_blocker_distance{1.0};
  /// Moment methods: standard deviation of the blur where that would be less than this many texels
  /// (a blur below a texel smooths nothing) or more (it would cost too much).
  double min_blur_texels = 1.0, max_blur_texels = 4.0;
  /// How far a surface may lie above another before it shades it, along the ray.
  Metres bias{0.0005};
  /// Maps fitted to the view: share of a partition's side over which it fades into the next.
  double blend_band = 0.05;
  /// Of FadingShadowMaps: what the sun moves between two sets of maps.
  Radians sun_step = FromDegrees(0.02);

  bool operator==(const ShadowMapOptions&) const = default;
};

/// What maps made with these options hold.
MapContent ContentOf(const ShadowMapOptions& options);

/// Errors (input): a number of partitions, a resolution, a λ or an angular radius out of the ranges
/// above.
Result<void> CheckShadowMapOptions(const ShadowMapOptions& options);

/// The options with which a method is commonly used: its partitions, each of `resolution` texels a
/// side or falling with distance.
ShadowMapOptions CommonOptions(ShadowMethod method, int resolution);

/// Something that casts shadows: indexed triangles with positions (vec3) at input 0 and 32-bit
/// indices. Every receiver must be a caster too, phantoms included.
struct ShadowCaster {
  const gl::GlVertexArray* vertices = nullptr;
  int index_count = 0;
  glm::dmat4 marker_from_model{1.0};
  Box bounds;                  ///< Marker coordinates; must hold all of it.
  std::uint64_t revision = 0;  ///< Change it when the buffers' content changes.
};

/// Z-partitioned shadow maps of the sun (Kolivand & Sunar 2014, with the deviations that
/// docs/method/shadows.md explains): per partition a depth map along the sun's rays, and what the
/// chosen visibility needs of it (a pyramid of depth bounds, or blurred moments). Maps are redrawn
/// only when casters, windows or the sun change; FadingShadowMaps follows a moving sun without
/// jumps. Needs a current GL context; move-only.
///
///     auto maps = ShadowMaps::Create({});
///     maps->UpdateForRegion(casters, to_sun, bounds_of_virtual_objects);
///     maps->Bind(0);  // then draw with a shader that includes shadow_visibility.glsl
class ShadowMaps {
 public:
  /// Errors: options out of range (kInput), no memory or shaders refused (kSystem).
  static Result<ShadowMaps> Create(const ShadowMapOptions& options);

  /// Fits the partitions to what a camera sees (Eq. 11), as the paper does. Returns how many maps
  /// were redrawn. Both Update functions leave the default framebuffer bound and depth test on.
  /// Errors (kInput): no sun direction, view depths out of order.
  Result<int> UpdateForView(std::span<const ShadowCaster> casters, Direction<Marker> to_sun,
                            const View& view);

  /// Fits the finest map to `focus` (usually the virtual objects), the last to all casters: nothing
  /// depends on the camera, so a recording with a still scene draws its maps once. Whatever the
  /// virtual objects shade, or what shades them, lies inside the finest map; with two sets of maps
  /// (with and without the virtual objects) visibilities differ nowhere outside it.
  Result<int> UpdateForRegion(std::span<const ShadowCaster> casters, Direction<Marker> to_sun,
                              const Box& focus);

  /// Draws all maps anew at the next update (measurements).
  void Invalidate() {
    for (Slice& slice : slices_) slice.drawn = {};
  }

  /// Makes the maps set number `set` of shadow_visibility.glsl: uniform block
  /// kUniformBlockBinding + set, texture units kTextureUnit + 2 set and the next.
  void Bind(int set) const;

  /// Makes the array of depths, 0…1 a partition, the texture of that unit (debug views).
  void BindDepth(int unit) const { depth_.Bind(unit); }

  /// Share that these maps have beside another step's, for SHADOW_CROSS_FADE.
  void SetShare(double share);

  /// What a shader must define for `sets` sets of maps made with these options.
  static std::vector<std::string> ShaderDefines(const ShadowMapOptions& options, int sets);

  /// One partition's depths, 0 nearest to the sun, 1 where nothing was drawn; row 0 at the lowest v
  /// (debug views). Waits for the renderer.
  Image<float> ReadDepth(int partition) const;

  const ShadowMapOptions& options() const { return options_; }
  const ShadowUniforms& uniforms() const { return uniforms_; }

 private:
  // All that a map's content depends on.
  struct CasterKey {
    GLuint vertices = 0;
    int index_count = 0;
    glm::dmat4 marker_from_model{1.0};
    std::uint64_t revision = 0;
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
    std::vector<gl::GlFramebuffer> bounds_targets;  // One a level of the pyramid.
    gl::GlFramebuffer moments_target;
  };

  // Moment methods: between the two passes.
  struct BlurBuffer {
    gl::GlTexture texture;
    gl::GlFramebuffer target;
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
  /// Nearest and farthest depth of a map.
  std::pair<double, double> DepthRange(const LightWindow& window, const LightExtent& scene) const;
  void DrawDepth(int slice, const LightAxes& axes);
  void DrawBounds(int slice);
  void DrawMoments(int slice);

  ShadowMapOptions options_;
  ShadowUniforms uniforms_{};
  gl::GlBuffer uniform_buffer_;
  gl::GlTexture depth_;    // Array of partitions, 0…1 over the depth range.
  gl::GlTexture bounds_;   // Pyramid of nearest and farthest depth, from a quarter of the size on.
  gl::GlTexture moments_;  // Moment methods.
  BlurBuffer blur_;
  gl::GlVertexArray no_vertices_;
  gl::GlProgram depth_program_;
  gl::GlProgram first_program_;   // Depth to bounds, or to moments blurred along u.
  gl::GlProgram second_program_;  // Bounds to bounds, or moments blurred along v.
  std::vector<Slice> slices_;
};

}  // namespace pleinair::shadows
