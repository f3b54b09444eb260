#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/image.h"
#include "base/vector.h"

namespace pleinair::tracker {

/// A dark quadrilateral on lighter surroundings: where the outer square of a marker may be.
struct Quad {
  /// Clockwise in the image, beginning anywhere; pixels, integers are centres; good to about one
  /// pixel, meant for refinement by who reads the marker.
  std::array<Vec2, 4> corners_px;
  float contrast;  ///< Codes outside the sides less codes inside, along the rim.
};

struct QuadDetectorOptions {
  double min_side_px = 8.0;  ///< Of any side in the image, foreshortened ones too.
};

/// Finds the outer squares of markers: a closed black rim, white around it, each a tenth of the
/// edge wide. First stage of the fast path; what it finds still has to be read.
///
/// Dark pixels beside their neighbourhood (dark_mask.h), three times: at full size for the thinnest
/// rims, at half size because means of four pixels carry less noise and blur, and at half size with
/// a lower threshold for prints crossed by the edge of a shadow. Components of them; the
/// quadrilateral in each convex hull; its sides moved to the steepest rise of light; kept when all
/// four sides are darker inside than outside by much the same factor.
///
/// Not thread-safe: buffers are kept, so that images after the first do not allocate. The same
/// image gives the same quads in the same order.
class QuadDetector {
 public:
  explicit QuadDetector(QuadDetectorOptions options = {});
  ~QuadDetector();
  QuadDetector(QuadDetector&&) noexcept;
  QuadDetector& operator=(QuadDetector&&) noexcept;

  /// One channel, any size; images too small to hold a quad give none.
  void Detect(ImageView<const std::uint8_t> grey, std::vector<Quad>* quads);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace pleinair::tracker
