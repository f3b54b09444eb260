#include "tracker/surf/integral_image.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/surf/integral_image.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// below[x] = above[x] + sum over grey[0..x], for x < width. Sums four pixels at once: within a
/// 128-bit block by two shifted additions, across blocks by a running total.
void AddRow(const std::uint8_t* grey, int width, const std::uint32_t* above, std::uint32_t* below) {
  std::uint32_t rest = 0;
  int x = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::FixedTag<std::uint32_t, 4> d32;
  const hn::FixedTag<std::uint8_t, 4> d8;
  auto total = hn::Zero(d32);
  for (; x + 4 <= width; x += 4) {
    auto sum = hn::PromoteTo(d32, hn::LoadU(d8, grey + x));
    sum = hn::Add(sum, hn::ShiftLeftLanes<1>(d32, sum));
    sum = hn::Add(sum, hn::ShiftLeftLanes<2>(d32, sum));
    sum = hn::Add(sum, total);
    total = hn::Broadcast<3>(sum);
    hn::StoreU(hn::Add(sum, hn::LoadU(d32, above + x)), d32, below + x);
  }
  rest = hn::GetLane(total);
#endif
  for (; x < width; ++x) {
    rest += grey[x];
    below[x] = above[x] + rest;
  }
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {
HWY_EXPORT(AddRow);
}  // namespace

void IntegralImage::Compute(ImageView<const std::uint8_t> grey) {
  CHECK_EQ(grey.channels(), 1);
  if (grey.width() != width_ || grey.height() != height_ || sums_.empty()) {
    width_ = grey.width();
    height_ = grey.height();
    stride_ = width_ + 1 + kPadding;
    sums_.assign(static_cast<std::size_t>(stride_) * (height_ + 1), 0);
  }
  for (int y = 0; y < height_; ++y) {
    std::uint32_t* above = sums_.data() + y * stride_;
    HWY_DYNAMIC_DISPATCH(AddRow)(grey.row(y), width_, above + 1, above + stride_ + 1);
  }
}

}  // namespace pleinair::tracker
#endif
