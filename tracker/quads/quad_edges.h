#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>

#include "base/image.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// Contrast along the four sides of a quadrilateral, from pairs of samples. One sample is at half
/// the width of the quiet zone, the other at half that of the black border.
struct RimEvidence {
  float contrast = 0.0F;  ///< Quiet zone minus border, 8-bit values, mean over the pairs.
  float min_side = 0.0F;  ///< The same for the weakest side, relative to its quiet zone's mean.
  /// Mean of border / quiet zone over the pairs. Under any light, a marker's black is the same
  /// fraction of its white.
  float ratio = 0.0F;
  float spread = 0.0F;  ///< Standard deviation of border / quiet zone relative to 1 - ratio.

  /// Small if the border is much darker than the quiet zone, and equally so on all sides.
  float Doubt() const { return ratio + 0.5F * spread; }
};

/// Refines each side to the steepest outward rise of intensity within a few pixels.
/// Gradient-weighted mean positions across the side determine a line; the lines' intersections are
/// the corners (as in Wang & Olson 2016, section III-C). Works in linear light, because in 8-bit
/// values an edge is shifted by up to 0.4 px towards its dark side. Returns false if no edge is
/// found or the result is not a convex quadrilateral inside the image.
bool RefineQuad(ImageView<const std::uint8_t> grey, double reach_px, int samples,
                std::array<Vec2, 4>* corners);

/// Samples both sides of the border's outer edge.
RimEvidence SampleRim(ImageView<const std::uint8_t> grey, const std::array<Vec2, 4>& corners);

}  // namespace pleinair::tracker
