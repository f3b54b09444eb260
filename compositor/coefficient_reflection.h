#pragma once

#include <array>
#include <span>

#include "compositor/coefficient_matrix.h"

namespace pleinair::compositor {

/// Light of one chunk of the sky's patches: red of all, green of all, blue of all.
using ChunkLight = std::array<float, 3 * CoefficientMatrix::kPatches>;

/// A place on a triangle that reflects to one patch of a surface.
struct ReflectingPlace {
  std::array<const ChunkLight*, 3> corners;  ///< What arrives at the triangle's corners.
  std::array<float, 3> weights;              ///< Barycentric.
  std::array<float, 3> shares;  ///< Of what arrives there, how much comes back; a channel each.
};

/// Adds to `sum` what comes from all places.
void AddReflections(std::span<const ReflectingPlace> places, ChunkLight* sum);
/// The same, one number after the other.
void AddReflectionsScalar(std::span<const ReflectingPlace> places, ChunkLight* sum);

}  // namespace pleinair::compositor
