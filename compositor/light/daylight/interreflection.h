#pragma once

#include <array>
#include <span>

#include "compositor/light/daylight/coefficient_matrix.h"

namespace pleinair::compositor {

/// Light of one chunk of sky patches: all red values, then green, then blue. Irradiance per
/// radiance of a patch (steradians, cosine included), as in CoefficientMatrix.
using ChunkLight = std::array<float, 3 * CoefficientMatrix::kPatches>;

/// A point on a triangle that reflects light to one patch of a surface.
struct ReflectingPlace {
  /// Light that arrives at the triangle's corners; must outlive the call.
  std::array<const ChunkLight*, 3> corners;
  std::array<float, 3> weights;  ///< Barycentric.
  /// Reflected fraction of the arriving light, one per channel: albedo / π times the weight of the
  /// rays that hit the point (steradians, cosine included).
  std::array<float, 3> shares;
};

/// Adds the light from all points to `sum`.
void AddInterreflections(std::span<const ReflectingPlace> places, ChunkLight* sum);
/// The same, without SIMD.
void AddInterreflectionsScalar(std::span<const ReflectingPlace> places, ChunkLight* sum);

}  // namespace pleinair::compositor
