#pragma once

#include <array>

#include "base/error.h"
#include "base/units.h"
#include "shadows/shadow_method.h"
#include "shadows/shadow_uniforms.h"

namespace pleinair::shadows {

/// Angular radius of the sun's disc at its mean distance: half of 0.533°.
constexpr Radians kSunAngularRadius = FromDegrees(0.2665);

/// Method, number, size and filter of the shadow maps.
struct ShadowMapOptions {
  ShadowMethod method = ShadowMethod::kSunDisc;
  SunDiscFilter sun_disc_filter = SunDiscFilter::kFull;
  int partitions = 2;         ///< 1 to 4.
  double split_weight = 0.5;  ///< λ of Eq. 11.
  /// 16…8192 texels per side; powers of two if the maps have a pyramid (MapContent::kDepthBounds).
  std::array<int, kMaxPartitions> resolutions{2048, 2048, 1024, 1024};
  Radians sun_angular_radius = kSunAngularRadius;
  /// Moment methods: caster distance at which the blur equals the disc's width.
  Metres blur_blocker_distance{1.0};
  /// Moment methods: limits of the blur's standard deviation in texels. A smaller blur has no
  /// effect; a larger one is too expensive.
  double min_blur_texels = 1.0, max_blur_texels = 4.0;
  /// Distance along the ray below which a surface does not shade another.
  Metres bias{0.0005};
  /// Maps fitted to the view: share of a partition's side over which it blends into the next.
  double blend_band = 0.05;
  /// FadingShadowMaps: change of the sun's direction between two sets of maps.
  Radians sun_step = FromDegrees(0.02);

  bool operator==(const ShadowMapOptions&) const = default;
};

/// Content of maps with these options.
MapContent ContentOf(const ShadowMapOptions& options);

/// Errors (input): number of partitions, resolution, λ or angular radius out of the ranges above.
Result<void> CheckShadowMapOptions(const ShadowMapOptions& options);

/// The options with which a method is commonly used: its number of partitions, each of `resolution`
/// texels per side or decreasing with distance.
ShadowMapOptions CommonOptions(ShadowMethod method, int resolution);

}  // namespace pleinair::shadows
