#include "tracker/alignment/reduced_pictures.h"

#include "base/check.h"

namespace pleinair::tracker {

void ReducedPictures::SetPicture(ImageView<const std::uint8_t> grey) {
  grey_ = grey;
  made_ = 0;
}

ImageView<const std::uint8_t> ReducedPictures::Level(int level) {
  CHECK_LT(level, kLevels);
  const auto view = [&](int l) -> ImageView<const std::uint8_t> {
    if (l == 0) return grey_;
    const int width = grey_.width() >> l, height = grey_.height() >> l;
    return {pixels_[l].data(), width, height, 1, width};
  };
  for (; made_ < level; ++made_) {
    const ImageView<const std::uint8_t> from = view(made_);
    const int width = grey_.width() >> (made_ + 1), height = grey_.height() >> (made_ + 1);
    pixels_[made_ + 1].resize(static_cast<std::size_t>(width) * height);
    for (int y = 0; y < height; ++y) {
      const std::uint8_t* a = from.row(2 * y);
      const std::uint8_t* b = from.row(2 * y + 1);
      std::uint8_t* to = &pixels_[made_ + 1][static_cast<std::size_t>(y) * width];
      for (int x = 0; x < width; ++x) {
        to[x] =
            static_cast<std::uint8_t>((a[2 * x] + a[2 * x + 1] + b[2 * x] + b[2 * x + 1] + 2) >> 2);
      }
    }
  }
  return view(level);
}

}  // namespace pleinair::tracker
