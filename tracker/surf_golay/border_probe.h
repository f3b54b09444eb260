#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// Which way round a print lies in a quadrilateral.
struct ProbedOrientation {
  int first_corner = 0;      ///< Index of the quadrilateral's corner that is the print's top-left,
  bool mirrored = false;     ///< … going on clockwise, or anticlockwise where mirrored.
  double correlation = 0.0;  ///< Of the border's modules with what is seen there: -1…1.
};

/// Looks at the centres of the border's modules inside a quadrilateral and tells which of its eight
/// orientations fits best. Costs microseconds, so that quadrilaterals that hold no marker are
/// dropped before anything is fitted.
class BorderProbe {
 public:
  BorderProbe();

  /// `corners_px` clockwise in a picture that sees a module as about a pixel or less. Best first.
  std::array<ProbedOrientation, 2> Look(ImageView<const std::uint8_t> grey,
                                        const std::array<Vec2, 4>& corners_px);

 private:
  struct Point {
    float column, row;               ///< Module's centre in 0…1 of the square.
    std::array<std::int16_t, 8> at;  ///< Index of the point that lies here when turned or mirrored.
  };
  std::vector<Point> points_;
  std::vector<float> ideal_;  ///< The border's modules less their mean, of unit length.
  std::vector<float> seen_;
};

}  // namespace pleinair::tracker
