#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// A point where edges of two directions meet.
struct CornerPoint {
  Vec2 at_px;             ///< Pixels; integers are centres.
  float strength = 0.0F;  ///< Förstner's weight: determinant of the structure tensor by its trace.
  int rank = 0;           ///< Among those of its tile, by strength.
};

/// Finds corners: maxima of the weight of Förstner & Gülch, "A fast operator for detection and
/// precise location of distinct points, corners and centres of circular features" (1987), eq. 9,
/// where the roundness (eq. 10) tells a corner from an edge; placed where the edges in the window
/// meet in the least squares (eq. 5). The strongest of each tile of the image, so that a marker
/// in the shade is not outdone by a tree in the sun.
class CornerPoints {
 public:
  /// Corners of an image by tiles, row by row. Buffers keep their capacity.
  const std::vector<CornerPoint>& Find(ImageView<const std::uint8_t> grey);

 private:
  struct Tensor {
    float xx, xy, yy;
  };
  void AddRow(ImageView<const std::uint8_t> grey, int y, float sign);
  Vec2 Place(ImageView<const std::uint8_t> grey, int x, int y) const;
  void KeepStrongest(int width);

  std::vector<float> weight_;                             ///< A pixel.
  std::vector<float> column_xx_, column_xy_, column_yy_;  ///< Sums over the window's rows.
  std::vector<CornerPoint> found_, corners_;
};

}  // namespace pleinair::tracker
