#pragma once

#include <array>

#include "base/camera_response.h"
#include "shadows/shadow_method.h"

namespace pleinair::compositor {

/// How the virtual shadows' edges are made; docs/measurements/shadows.md compares the methods.
using shadows::ShadowMethod;

/// Work that a Composer saves, with images that are equal but for a step of eight bits or, in very
/// few values, three. Each can be switched off to measure what it saves or to compare images
/// (docs/method/compositing.md, "Shortcuts").
struct DrawReductions {
  bool affected_triangles = true;    ///< Shades only phantom triangles whose light may change.
  bool sun_footprint = true;         ///< Bounds the objects' shadows by what they cover.
  bool sun_visibility = true;        ///< Uses what the solver knows of the sun on a triangle.
  bool linear_shadow_ratio = true;   ///< Interpolates the ratio where it is linear.
  bool sun_facing_triangles = true;  ///< No shadow map on an object's triangles in their own shade.

  /// Everything is drawn.
  static constexpr DrawReductions None() { return {false, false, false, false, false}; }
  bool operator==(const DrawReductions&) const = default;
};

/// How a Composer draws.
struct ComposerOptions {
  /// Render pixels a camera pixel and side, on top of 4× multisampling. 0: 1 for a lens without
  /// distortion, 1.5 for one that the picture must be warped to.
  double supersampling = 0.0;
  ShadowMethod shadow_method = ShadowMethod::kSunDisc;
  shadows::SunDiscFilter sun_disc_filter = shadows::SunDiscFilter::kFull;
  int shadow_partitions = 2;  ///< Partitions of the shadow maps, 1…4.
  /// Texels a side of each partition's map, 16…8192; powers of two where the method has a pyramid
  /// (shadows::MapContent::kDepthBounds). 0: as fine as the picture shows; finer ones cost a look
  /// at every texel that a pixel covers, and 1024 are enough for 640 pixels
  /// (docs/method/shadows.md).
  std::array<int, 4> shadow_sizes{};
  double shadow_split_weight = 0.5;  ///< λ of the paper's Eq. 11, for maps fitted to the view.
  /// Methods that blur moments: distance of the blocker at which the blur has the sun's width.
  double shadow_blur_distance_m = 1.0;
  /// Fog before the virtual objects, by partition of the view (aerial_fog.h): times what the sky's
  /// own air does, 0 none. Partitions are cut as the shadow maps' are, from near to far.
  std::array<double, 4> fog{1.0, 1.0, 1.0, 1.0};
  /// Tints the shadow maps' partitions and shows the maps: shadow_debug_view.h.
  bool show_shadow_maps = false;
  DrawReductions reductions;     ///< All, unless for measuring.
  CameraResponse response = {};  ///< How the camera's codes are read and written.

  bool operator==(const ComposerOptions&) const = default;
};

}  // namespace pleinair::compositor
