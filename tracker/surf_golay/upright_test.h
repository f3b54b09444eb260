#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstdint>

#include "base/image.h"
#include "base/vector.h"
#include "tracker/alignment/block_fit.h"
#include "tracker/alignment/lens_grid.h"
#include "tracker/alignment/reduced_images.h"
#include "tracker/surf_golay/orientation_test.h"
#include "tracker/surf_golay/sg_reading.h"

namespace pleinair::tracker {

/// Tests the orientation of markers in an image, each at the pyramid level where its modules are
/// about one pixel.
class UprightTest {
 public:
  explicit UprightTest(const LensGrid& lens) : lens_(lens) {}

  /// Image for the following tests; kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey) { reduced_.SetImage(grey); }
  ReducedImages& reduced() { return reduced_; }

  /// The best two orientations of a marker whose square has these corners, clockwise; from single
  /// pixels.
  std::array<BorderOrientation, 2> Orientations(std::array<Vec2, 4> corners_px);
  /// As above, for the square of a homography.
  std::array<BorderOrientation, 2> Orientations(const Mat3& modules_from_undistorted);
  /// Correlation of the border's pixels in this orientation; 0 if another orientation is better.
  double UprightCorrelation(const BlockFitState& state);
  /// Whether a decoded marker is upright, not rotated or mirrored.
  bool IsUpright(const SgReading& reading);

 private:
  const LensGrid& lens_;
  ReducedImages reduced_;
  OrientationTest orientation_test_;
};

}  // namespace pleinair::tracker
