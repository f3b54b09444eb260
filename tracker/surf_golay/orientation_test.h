#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/image.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// Orientation of a marker in a quadrilateral.
struct BorderOrientation {
  int first_corner = 0;  ///< Index of the quadrilateral's corner that is the marker's top-left; the
                         ///< others follow
  bool mirrored = false;     ///< clockwise, or anticlockwise if mirrored.
  double correlation = 0.0;  ///< Correlation of the border's modules with the observation: -1…1.
};

/// Samples the centres of the border's modules inside a quadrilateral and finds the best of its
/// eight orientations. Takes microseconds, so that quadrilaterals without a marker are rejected
/// before any fit.
class OrientationTest {
 public:
  OrientationTest();

  /// `corners_px`: clockwise, in an image with modules of about a pixel or less. Best first.
  std::array<BorderOrientation, 2> Evaluate(ImageView<const std::uint8_t> grey,
                                            const std::array<Vec2, 4>& corners_px);

 private:
  static constexpr int kOrientations = 8;  ///< Four rotations, then those of the mirrored marker.

  std::vector<float> u_, v_;  ///< Centres of the modules, in half edges from the square's centre, y
                              ///< up.
  /// Expected values there in each orientation: zero mean, unit length.
  std::vector<std::array<float, kOrientations>> expected_;
  std::vector<std::int32_t> x_, y_;
};

}  // namespace pleinair::tracker
