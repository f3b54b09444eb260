#pragma once
// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracker/surf/integral_image.h"

namespace pleinair::tracker {

/// Box-filtered image: means over boxes of `box` x `box` px, one every `step` px. Element (i, j)
/// covers the pixels [i step, i step + box) x [j step, j step + box), so its centre is at i step +
/// (box - 1) / 2. The last row and column are duplicated once.
struct BoxLevel {
  int box = 1;     ///< px
  int step = 1;    ///< px
  int width = 0;   ///< Elements per row, without the duplicate.
  int height = 0;  ///< Rows, without the duplicate.
  std::ptrdiff_t stride = 0;
  std::vector<std::uint16_t> means;  ///< Grey x 256.

  const std::uint16_t* row(int y) const { return means.data() + y * stride; }
};

/// The image filtered by boxes of several sizes, computed from the integral image on first use.
/// Memory is reused between images.
class BoxLevels {
 public:
  /// Sets the image for the following calls; it must outlive them.
  void Reset(const IntegralImage* integral);

  /// The level whose box is nearest to `size_px` (by ratio) and fits into the image, which must not
  /// be empty.
  const BoxLevel& Nearest(float size_px);

 private:
  static constexpr int kLevels = 9;
  void Fill(BoxLevel* level);

  const IntegralImage* integral_ = nullptr;
  std::array<BoxLevel, kLevels> levels_;
  std::array<bool, kLevels> filled_ = {};
  std::vector<std::int32_t> sums_;
};

}  // namespace pleinair::tracker
