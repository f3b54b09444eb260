#pragma once

#include <vector>

#include "base/image.h"

namespace pleinair::tracker {

/// A target's picture in linear light and its halves, each the mean of 2×2 of the one before: pixel
/// X of level l covers pixels [X 2^l, (X + 1) 2^l) of the picture.
class PicturePyramid {
 public:
  explicit PicturePyramid(ImageView<const std::uint8_t> picture);

  int levels() const { return static_cast<int>(levels_.size()); }
  const Image<float>& level(int l) const { return levels_[l]; }
  int width() const { return levels_[0].width(); }
  int height() const { return levels_[0].height(); }

 private:
  std::vector<Image<float>> levels_;  ///< 1 is what all but the brightest 2 % do not exceed.
};

}  // namespace pleinair::tracker
