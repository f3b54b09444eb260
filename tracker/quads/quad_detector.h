#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/image.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// A dark quadrilateral on lighter surroundings: a candidate for the outer square of a marker.
struct Quad {
  /// Clockwise in the image, starting at any corner; pixels, integers are centres. Accurate to
  /// about one pixel; the decoder refines them.
  std::array<Vec2, 4> corners_px;
  float contrast;  ///< 8-bit values outside minus inside the sides, along the border.
};

struct QuadDetectorOptions {
  double min_side_px = 8.0;  ///< Minimum length of each side in the image, foreshortened ones
                             ///< included.
};

/// Detects the outer squares of markers: a closed black border with white around it, each a tenth
/// of the edge wide. First stage of the fast path; the content is decoded afterwards.
///
/// Steps: adaptive thresholds (dark_mask.h), connected components, the best quadrilateral in each
/// convex hull, refinement of its sides to the steepest gradient. Thresholds apply at full size for
/// the thinnest borders, and at half size because means of four pixels have less noise. A third
/// threshold, lower and at half size, is for markers with a shadow edge. A quadrilateral is kept if
/// all four sides are darker inside than outside by a similar factor.
///
/// Not thread-safe: buffers are reused, so that only the first image allocates. Deterministic, in
/// the order of the results too.
class QuadDetector {
 public:
  explicit QuadDetector(QuadDetectorOptions options = {});
  ~QuadDetector();
  QuadDetector(QuadDetector&&) noexcept;
  QuadDetector& operator=(QuadDetector&&) noexcept;

  /// One channel, any size; images too small for a quadrilateral give none.
  void Detect(ImageView<const std::uint8_t> grey, std::vector<Quad>* quads);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace pleinair::tracker
