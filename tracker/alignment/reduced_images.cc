#include "tracker/alignment/reduced_images.h"

#include <utility>

#include "base/check.h"
#include "tracker/quads/dark_mask.h"

namespace pleinair::tracker {

void ReducedImages::SetImage(ImageView<const std::uint8_t> grey) {
  grey_ = grey;
  made_ = 0;
}

ImageView<const std::uint8_t> ReducedImages::Level(int level) {
  CHECK_LT(level, kLevels);
  const auto view = [&](int l) -> ImageView<const std::uint8_t> {
    return l == 0 ? grey_ : std::as_const(images_[l]).view();
  };
  for (; made_ < level; ++made_) {
    HalveImage(view(made_), SimdDarkMaskKernels(), &images_[made_ + 1]);
  }
  return view(level);
}

}  // namespace pleinair::tracker
