#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstdint>

#include "base/image.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// What an image shows along the four sides of a quadrilateral: pairs of codes, one in the middle
/// of the quiet zone and one in the middle of the rim.
struct RimEvidence {
  float contrast = 0.0F;  ///< Codes of the quiet zone less codes of the rim, mean over the pairs.
  float min_side = 0.0F;  ///< The same of the weakest side, as a share of its quiet zone's mean.
  /// Mean of rim/quiet zone over the pairs; whatever light falls on a marker, its black is the same
  /// share of its white.
  float ratio = 0.0F;
  float spread = 0.0F;  ///< Standard deviation of rim/quiet zone as a share of 1 - ratio.

  /// Small where the rim is much darker than the quiet zone, and equally so all round.
  float Doubt() const { return ratio + 0.5F * spread; }
};

/// Moves each side to where the image's light rises most from inside to outside, within a few
/// pixels: gradient-weighted mean positions across the side, a line through them, the corners where
/// the lines meet (as Wang & Olson 2016, section III-C, refine the edges of a quad). In linear
/// light, since in codes an edge lies up to 0.4 px too far on its dark side. False where no edge
/// was found or what comes out is no convex quadrilateral in the image.
bool RefineQuad(ImageView<const std::uint8_t> grey, double reach_px, int samples,
                std::array<Vec2, 4>* corners);

/// Samples both sides of the rim's outer edge.
RimEvidence SampleRim(ImageView<const std::uint8_t> grey, const std::array<Vec2, 4>& corners);

}  // namespace pleinair::tracker
