#pragma once
// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tracker/surf/integral_image.h"

namespace pleinair::tracker {

/// Means over boxes of `box` x `box` px, one every `step` px. Element (i, j) covers the pixels
/// [i step, i step + box) x [j step, j step + box), so that its centre is at
/// i step + (box - 1) / 2. A last row and column repeat the ones before them.
struct BoxLevel {
  int box = 1;     ///< px
  int step = 1;    ///< px
  int width = 0;   ///< Elements in a row, without the repeated one.
  int height = 0;  ///< Rows, without the repeated one.
  std::ptrdiff_t stride = 0;
  std::vector<std::uint16_t> means;  ///< Grey x 256.

  const std::uint16_t* row(int y) const { return means.data() + y * stride; }
};

/// The image smoothed by boxes of several sizes, from the integral image. Each is made when it is
/// first asked for, and keeps its memory.
class BoxLevels {
 public:
  /// Everything asked for from now on is of this image, which must live as long.
  void Reset(const IntegralImage* integral);

  /// The level whose box is nearest to `size_px` (by ratio) and fits into the image, which is not
  /// empty.
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
