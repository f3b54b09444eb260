#include "tracker/surf/double_size.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/surf/double_size.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// One row of 2 width - 1 pixels from two of `width` (the same one twice on even rows): the pixels
/// and the means between them. Means are rounded up, as means of pairs of pairs.
void DoubleRow(const std::uint8_t* upper, const std::uint8_t* lower, int width,
               std::uint8_t* doubled) {
  const hn::ScalableTag<std::uint8_t> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  int x = 0;
  for (; x + lanes < width; x += lanes) {
    const auto here = hn::AverageRound(hn::LoadU(d, upper + x), hn::LoadU(d, lower + x));
    const auto next = hn::AverageRound(hn::LoadU(d, upper + x + 1), hn::LoadU(d, lower + x + 1));
    hn::StoreInterleaved2(here, hn::AverageRound(here, next), d, doubled + 2 * x);
  }
  const auto mean = [](int a, int b) { return (a + b + 1) / 2; };
  for (; x < width; ++x) {
    const int here = mean(upper[x], lower[x]);
    doubled[2 * x] = static_cast<std::uint8_t>(here);
    if (x + 1 == width) break;
    doubled[2 * x + 1] = static_cast<std::uint8_t>(mean(here, mean(upper[x + 1], lower[x + 1])));
  }
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {
HWY_EXPORT(DoubleRow);
}  // namespace

void DoubleSize(ImageView<const std::uint8_t> grey, Image<std::uint8_t>* doubled) {
  const int width = grey.empty() ? 0 : 2 * grey.width() - 1;
  const int height = grey.empty() ? 0 : 2 * grey.height() - 1;
  if (doubled->width() != width || doubled->height() != height) {
    *doubled = Image<std::uint8_t>(width, height);
  }
  for (int y = 0; y < height; ++y) {
    HWY_DYNAMIC_DISPATCH(DoubleRow)
    (grey.row(y / 2), grey.row((y + 1) / 2), grey.width(),
     doubled->data() + static_cast<std::ptrdiff_t>(y) * width);
  }
}

}  // namespace pleinair::tracker
#endif
