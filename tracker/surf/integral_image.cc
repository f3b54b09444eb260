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

/// below[x] = above[x] + sum over grey[0..x], for x < width, row by row: row r + 1 is at `to` + (r
/// + 1) `to_stride`. Sums four pixels at once: two shifted additions within a 128-bit block, a
/// running total across blocks. Each block waits for the total before it, so several rows are
/// processed side by side.
template <int kRows>
void AddSome(const std::uint8_t* grey, std::ptrdiff_t stride, int width, std::uint32_t* to,
             std::ptrdiff_t to_stride) {
  std::uint32_t rest[kRows] = {};
  int x = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::FixedTag<std::uint32_t, 4> d32;
  const hn::FixedTag<std::uint8_t, 4> d8;
  hn::Vec<decltype(d32)> total[kRows];
  for (auto& sum : total) sum = hn::Zero(d32);
  for (; x + 4 <= width; x += 4) {
    auto above = hn::LoadU(d32, to + x);
    for (int r = 0; r < kRows; ++r) {
      auto sum = hn::PromoteTo(d32, hn::LoadU(d8, grey + r * stride + x));
      sum = hn::Add(sum, hn::ShiftLeftLanes<1>(d32, sum));
      sum = hn::Add(sum, hn::ShiftLeftLanes<2>(d32, sum));
      sum = hn::Add(sum, total[r]);
      total[r] = hn::Broadcast<3>(sum);
      above = hn::Add(sum, above);
      hn::StoreU(above, d32, to + (r + 1) * to_stride + x);
    }
  }
  for (int r = 0; r < kRows; ++r) rest[r] = hn::GetLane(total[r]);
#endif
  for (; x < width; ++x) {
    for (int r = 0; r < kRows; ++r) {
      rest[r] += grey[r * stride + x];
      to[(r + 1) * to_stride + x] = to[r * to_stride + x] + rest[r];
    }
  }
}

void AddRows(const std::uint8_t* grey, std::ptrdiff_t stride, int width, int height,
             std::uint32_t* to, std::ptrdiff_t to_stride) {
  constexpr int kTogether = 4;
  int y = 0;
  for (; y + kTogether <= height; y += kTogether) {
    AddSome<kTogether>(grey + y * stride, stride, width, to + y * to_stride, to_stride);
  }
  for (; y < height; ++y) {
    AddSome<1>(grey + y * stride, stride, width, to + y * to_stride, to_stride);
  }
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {
HWY_EXPORT(AddRows);

constexpr std::ptrdiff_t kLine = 64 / sizeof(std::uint32_t);  ///< A cache line.
}  // namespace

void IntegralImage::Compute(ImageView<const std::uint8_t> grey) {
  CHECK_EQ(grey.channels(), 1);
  if (grey.width() != width_ || grey.height() != height_ || sums_.empty()) {
    width_ = grey.width();
    height_ = grey.height();
    stride_ = (width_ + 1 + kPadding + kLine - 1) / kLine * kLine;
    sums_.assign(static_cast<std::size_t>(stride_) * (height_ + 1) + kLine, 0);
    const auto address = reinterpret_cast<std::uintptr_t>(sums_.data()) / sizeof(std::uint32_t);
    front_ = (kLine - static_cast<std::ptrdiff_t>(address % kLine)) % kLine;
  }
  HWY_DYNAMIC_DISPATCH(AddRows)
  (grey.data(), grey.stride(), width_, height_, sums_.data() + front_ + 1, stride_);
}

}  // namespace pleinair::tracker
#endif
