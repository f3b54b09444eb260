#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// Which way round a marker lies in a quadrilateral.
struct BorderOrientation {
  int first_corner = 0;      ///< Index of the quadrilateral's corner that is the marker's top-left,
  bool mirrored = false;     ///< … going on clockwise, or anticlockwise where mirrored.
  double correlation = 0.0;  ///< Of the border's modules with what is observed there: -1…1.
};

/// Looks at the centres of the border's modules inside a quadrilateral and tells which of its eight
/// orientations fits best. Costs microseconds, so that quadrilaterals that hold no marker are
/// dropped before anything is fitted.
class OrientationTest {
 public:
  OrientationTest();

  /// `corners_px` clockwise in an image that sees a module as about a pixel or less. Best first.
  std::array<BorderOrientation, 2> Evaluate(ImageView<const std::uint8_t> grey,
                                            const std::array<Vec2, 4>& corners_px);

 private:
  static constexpr int kOrientations = 8;  ///< Four turns, then those of the mirrored marker.

  std::vector<float> u_, v_;  ///< Modules' centres, in half edges from the square's, y up.
  /// What should be observed at each of them in each orientation: less its mean, of unit length.
  std::vector<std::array<float, kOrientations>> expected_;
  std::vector<std::int32_t> x_, y_;
};

}  // namespace pleinair::tracker
