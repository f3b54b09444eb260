#pragma once

#include <vector>

#include "base/image.h"

namespace pleinair::tracker {

/// Image pyramid of a target in linear light. Each level is the mean of 2×2 pixels of the one
/// before: pixel X of level l covers pixels [X 2^l, (X + 1) 2^l) of the target's image.
class PicturePyramid {
 public:
  explicit PicturePyramid(ImageView<const std::uint8_t> picture);

  int levels() const { return static_cast<int>(levels_.size()); }
  const Image<float>& level(int l) const { return levels_[l]; }
  int width() const { return levels_[0].width(); }
  int height() const { return levels_[0].height(); }

 private:
  std::vector<Image<float>> levels_;  ///< Scaled so that 98 % of the pixels are at most 1.
};

}  // namespace pleinair::tracker
