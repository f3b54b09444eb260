#pragma once

// Internal: between the .cc files of this module; not installed.

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

/// Tests which way round markers lie in an image, each in the reduction of the image that sees its
/// modules as about a pixel.
class UprightTest {
 public:
  explicit UprightTest(const LensGrid& lens) : lens_(lens) {}

  /// The image that the following tests look at; kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey) { reduced_.SetImage(grey); }
  ReducedImages& reduced() { return reduced_; }

  /// The best two orientations of a marker whose square has these corners, clockwise; by pixels
  /// alone.
  std::array<BorderOrientation, 2> Orientations(std::array<Vec2, 4> corners_px);
  /// The same of a homography's square.
  std::array<BorderOrientation, 2> Orientations(const Mat3& modules_from_undistorted);
  /// Correlation of the border's pixels this way round; 0 where another is better.
  double UprightCorrelation(const BlockFitState& state);
  /// Whether a marker that was read lies upright rather than turned or mirrored.
  bool IsUpright(const SgReading& reading);

 private:
  const LensGrid& lens_;
  ReducedImages reduced_;
  OrientationTest orientation_test_;
};

}  // namespace pleinair::tracker
