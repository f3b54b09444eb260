#pragma once

#include <array>
#include <cstdint>

#include "base/image.h"

namespace pleinair::tracker {

/// A picture and its halves: each level's pixel is the mean of four of the level before (of their
/// codes: good for finding, not for measuring). Levels are made when first asked for.
class ReducedPictures {
 public:
  static constexpr int kLevels = 6;

  /// Forgets the levels of the picture before; `grey` is kept by reference.
  void SetPicture(ImageView<const std::uint8_t> grey);
  /// Level 0 is the picture itself; a level may be empty where the picture is small.
  ImageView<const std::uint8_t> Level(int level);

 private:
  ImageView<const std::uint8_t> grey_;
  std::array<Image<std::uint8_t>, kLevels> pictures_;
  int made_ = 0;  ///< The last level that is there.
};

}  // namespace pleinair::tracker
