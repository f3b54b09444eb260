#pragma once

#include <array>

#include "base/camera_response.h"
#include "compositor/antialiasing.h"
#include "shadows/shadow_method.h"

namespace pleinair::compositor {

/// Method of the virtual shadows' edges; docs/measurements/shadows.md compares the methods.
using shadows::ShadowMethod;

/// Shortcuts of a Composer. Each changes images by at most two 8-bit steps, very few values by
/// three. Each can be switched off to measure what it saves or to compare images
/// (docs/method/compositing.md, "Shortcuts").
struct DrawReductions {
  bool affected_triangles = true;   ///< Shades only phantom triangles whose light may change.
  bool sun_footprint = true;        ///< Bounds the objects' shadows by their extent in light space.
  bool sun_visibility = true;       ///< Uses the solver's sun visibility per triangle.
  bool linear_shadow_ratio = true;  ///< Interpolates the ratio where it is linear.
  /// No shadow map on object triangles that face away from the sun.
  bool sun_facing_triangles = true;
  /// Draws only tiles of the image that objects may affect, and copies the others.
  bool affected_tiles = true;
  /// Interpolates smooth ratios from a coarse grid. Requires affected_tiles. Surfaces thinner than
  /// four pixels may change by more than two steps.
  bool coarse_sky_ratio = true;

  /// Everything is drawn.
  static constexpr DrawReductions None() {
    return {false, false, false, false, false, false, false};
  }
  bool operator==(const DrawReductions&) const = default;
};

/// How a Composer draws.
struct ComposerOptions {
  Antialiasing antialiasing = {};
  /// Render pixels per camera pixel and side, in addition to the antialiasing. 0: 1 for a lens
  /// without distortion, 1.5 for one with distortion, whose image is warped.
  double supersampling = 0.0;
  ShadowMethod shadow_method = ShadowMethod::kSunDisc;
  shadows::SunDiscFilter sun_disc_filter = shadows::SunDiscFilter::kFull;
  int shadow_partitions = 2;  ///< Partitions of the shadow maps, 1…4.
  /// Texels per side of each partition's map, 16…8192. Must be powers of two where the method has a
  /// pyramid (shadows::MapContent::kDepthBounds). 0: as fine as the image resolves. Finer maps cost
  /// a visit to every texel that a pixel covers. 1024 are enough for 640 pixels
  /// (docs/method/shadows.md).
  std::array<int, 4> shadow_sizes{};
  double shadow_split_weight = 0.5;  ///< λ of the paper's Eq. 11, for maps fitted to the view.
  /// Blocker distance at which the blur has the sun's width, for methods that blur moments.
  double shadow_blur_distance_m = 1.0;
  /// Density of the fog in front of the virtual objects, per partition of the view (aerial_fog.h).
  /// 1: the air of the sky model; 0: none. Partitions are cut as those of the shadow maps, from
  /// near to far.
  std::array<double, 4> fog{1.0, 1.0, 1.0, 1.0};
  /// Tints the shadow maps' partitions and shows the maps (shadow_debug_view.h).
  bool show_shadow_maps = false;
  DrawReductions reductions;     ///< All, except for measurements.
  CameraResponse response = {};  ///< Between the camera's pixel values and light.

  bool operator==(const ComposerOptions&) const = default;
};

}  // namespace pleinair::compositor
