#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstdint>
#include <vector>

#include "base/image.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// A corner: a point where edges of two directions meet.
struct CornerPoint {
  Vec2 at_px;             ///< Pixels; integers are centres.
  float strength = 0.0F;  ///< Förstner's weight: determinant over trace of the structure tensor.
  int rank = 0;           ///< Rank by strength in its tile.
};

/// Corner detector of Förstner & Gülch, "A fast operator for detection and precise location of
/// distinct points, corners and centres of circular features" (1987): maxima of the weight (eq. 9),
/// with the roundness (eq. 10) to reject edges, at the least-squares intersection of the edges in
/// the window (eq. 5). It keeps the strongest of each tile of the image, so that a marker in shadow
/// is not displaced by texture in the sun.
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

  std::vector<float> weight_;                             ///< Per pixel.
  std::vector<float> column_xx_, column_xy_, column_yy_;  ///< Sums over the window's rows.
  std::vector<CornerPoint> found_, corners_;
};

}  // namespace pleinair::tracker
