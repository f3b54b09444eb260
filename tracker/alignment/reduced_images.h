#pragma once

#include <array>
#include <cstdint>

#include "base/image.h"

namespace pleinair::tracker {

/// An image and its halves: each level's pixel is the mean of four of the level before (of their
/// codes: good for finding, not for measuring). Levels are made when first asked for.
class ReducedImages {
 public:
  static constexpr int kLevels = 6;

  /// Forgets the levels of the image before; `grey` is kept by reference.
  void SetImage(ImageView<const std::uint8_t> grey);
  /// Level 0 is the image itself; a level may be empty where the image is small.
  ImageView<const std::uint8_t> Level(int level);

 private:
  ImageView<const std::uint8_t> grey_;
  std::array<Image<std::uint8_t>, kLevels> images_;
  int made_ = 0;  ///< The last level that is there.
};

}  // namespace pleinair::tracker
