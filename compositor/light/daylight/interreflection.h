#pragma once

#include <array>
#include <span>

#include "compositor/light/daylight/coefficient_matrix.h"

namespace pleinair::compositor {

/// Light of one chunk of the sky's patches: red of all, green of all, blue of all. Irradiance per
/// radiance of a patch (steradians, cosine counted), as in CoefficientMatrix.
using ChunkLight = std::array<float, 3 * CoefficientMatrix::kPatches>;

/// A place on a triangle that reflects to one patch of a surface.
struct ReflectingPlace {
  /// What arrives at the triangle's corners; must outlive the call.
  std::array<const ChunkLight*, 3> corners;
  std::array<float, 3> weights;  ///< Barycentric.
  /// Of what arrives there, how much comes back: albedo / pi times the weight (steradians, cosine
  /// counted) of the rays that met it; a channel each.
  std::array<float, 3> shares;
};

/// Adds to `sum` what comes from all places.
void AddInterreflections(std::span<const ReflectingPlace> places, ChunkLight* sum);
/// The same, one number after the other.
void AddInterreflectionsScalar(std::span<const ReflectingPlace> places, ChunkLight* sum);

}  // namespace pleinair::compositor
