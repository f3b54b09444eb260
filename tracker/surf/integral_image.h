#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/image.h"

namespace pleinair::tracker {

/// Integral image (Bay et al. 2008, Eq. (1)), with a leading row and column of zeros: row(y)[x] is
/// the sum over the pixels above y and left of x.
///
/// Sums are modulo 2^32. An image of 8K overflows that, but box sums by the same arithmetic are
/// correct as long as they are below 2^32 (16.8 million white pixels).
class IntegralImage {
 public:
  /// Vector code may read (never use) this many elements beyond the end of any row.
  static constexpr int kPadding = 64;

  /// `grey` has one channel and may be empty. Memory is reused between calls.
  void Compute(ImageView<const std::uint8_t> grey);

  int width() const { return width_; }    ///< px of the image.
  int height() const { return height_; }  ///< px of the image.
  /// Row 0..height(), elements 0..width(). Rows are aligned to cache lines.
  const std::uint32_t* row(int y) const { return sums_.data() + front_ + y * stride_; }

  /// Sum over the pixels x0 <= x < x1, y0 <= y < y1, all inside the image.
  std::uint32_t BoxSum(int x0, int y0, int x1, int y1) const {
    return row(y1)[x1] - row(y1)[x0] - row(y0)[x1] + row(y0)[x0];
  }

 private:
  int width_ = 0;
  int height_ = 0;
  std::ptrdiff_t front_ = 0;  ///< Unused elements before the first whole cache line.
  std::ptrdiff_t stride_ = 0;
  std::vector<std::uint32_t> sums_;
};

}  // namespace pleinair::tracker
