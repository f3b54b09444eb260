#pragma once

#include <array>
#include <cstdint>

#include "base/image.h"

namespace pleinair::tracker {

/// An image pyramid: each pixel is the mean of four pixels of the next finer level. It averages
/// 8-bit values: suited to finding markers, not to measuring them. Levels are computed on first
/// use.
class ReducedImages {
 public:
  static constexpr int kLevels = 6;

  /// Discards the levels of the previous image; `grey` is kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey);
  /// Level 0 is the image itself; levels of small images may be empty.
  ImageView<const std::uint8_t> Level(int level);

 private:
  ImageView<const std::uint8_t> grey_;
  std::array<Image<std::uint8_t>, kLevels> images_;
  int made_ = 0;  ///< Highest level computed so far.
};

}  // namespace pleinair::tracker
