#include "tracker/surf/box_levels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/surf/box_levels.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// sums[x]: sum over the box whose left edge is x, between two rows of the integral image.
void SumBoxes(const std::uint32_t* above, const std::uint32_t* below, int box, int count,
              std::int32_t* sums) {
  const hn::ScalableTag<std::uint32_t> du;
  const hn::RebindToSigned<decltype(du)> di;
  for (int x = 0; x < count; x += static_cast<int>(hn::Lanes(du))) {
    const auto right = hn::Sub(hn::LoadU(du, below + x + box), hn::LoadU(du, above + x + box));
    const auto left = hn::Sub(hn::LoadU(du, below + x), hn::LoadU(du, above + x));
    hn::StoreU(hn::BitCast(di, hn::Sub(right, left)), di, sums + x);
  }
}

/// means[i] = sums[i step] * scale, rounded.
void ScaleSums(const std::int32_t* sums, int step, int count, float scale, std::uint16_t* means) {
  const hn::ScalableTag<std::int32_t> di;
  const hn::RebindToFloat<decltype(di)> df;
  const hn::Rebind<std::uint16_t, decltype(di)> d16;
  const auto factor = hn::Set(df, scale);
  const int lanes = static_cast<int>(hn::Lanes(di));
  using V = hn::Vec<decltype(di)>;
  for (int i = 0; i < count; i += lanes) {
    V sum, skipped1, skipped2, skipped3;
    if (step == 1) {
      sum = hn::LoadU(di, sums + i);
    } else if (step == 2) {
      hn::LoadInterleaved2(di, sums + i * 2, sum, skipped1);
    } else {
      hn::LoadInterleaved4(di, sums + i * 4, sum, skipped1, skipped2, skipped3);
    }
    const auto mean = hn::NearestInt(hn::Mul(hn::ConvertTo(df, sum), factor));
    hn::StoreU(hn::DemoteTo(d16, mean), d16, means + i);
  }
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {

HWY_EXPORT(SumBoxes);
HWY_EXPORT(ScaleSums);

/// Box sizes up to about twice the largest scale of four octaves, at most a factor 1.5 apart beyond
/// 2. A box is sampled at least twice, so that interpolation between samples does no harm.
struct BoxAndStep {
  int box, step;
};
constexpr std::array<BoxAndStep, 9> kBoxes = {
    {{1, 1}, {2, 1}, {3, 1}, {4, 2}, {6, 2}, {8, 4}, {12, 4}, {16, 4}, {24, 4}}};

}  // namespace

void BoxLevels::Reset(const IntegralImage* integral) {
  integral_ = integral;
  filled_.fill(false);
}

const BoxLevel& BoxLevels::Nearest(float size_px) {
  const int largest = std::min(integral_->width(), integral_->height());
  int nearest = 0;
  for (int k = 1; k < kLevels && kBoxes[k].box <= largest; ++k) {
    const float between =
        std::sqrt(static_cast<float>(kBoxes[k].box) * static_cast<float>(kBoxes[k - 1].box));
    if (size_px > between) nearest = k;
  }
  BoxLevel& level = levels_[nearest];
  if (!filled_[nearest]) {
    level.box = kBoxes[nearest].box;
    level.step = kBoxes[nearest].step;
    Fill(&level);
    filled_[nearest] = true;
  }
  return level;
}

void BoxLevels::Fill(BoxLevel* level) {
  const int lefts = integral_->width() - level->box + 1;
  const int tops = integral_->height() - level->box + 1;
  level->width = (lefts - 1) / level->step + 1;
  level->height = (tops - 1) / level->step + 1;
  level->stride = level->width + 1 + IntegralImage::kPadding;
  level->means.resize(static_cast<std::size_t>(level->stride) * (level->height + 1));
  sums_.resize(std::max<std::size_t>(sums_.size(), lefts + 4 * IntegralImage::kPadding));
  const float scale = 256.0f / static_cast<float>(level->box * level->box);
  std::uint16_t* means = level->means.data();
  for (int j = 0; j < level->height; ++j, means += level->stride) {
    const int y = j * level->step;
    HWY_DYNAMIC_DISPATCH(SumBoxes)
    (integral_->row(y), integral_->row(y + level->box), level->box, lefts, sums_.data());
    HWY_DYNAMIC_DISPATCH(ScaleSums)(sums_.data(), level->step, level->width, scale, means);
    means[level->width] = means[level->width - 1];
  }
  std::copy_n(means - level->stride, level->stride, means);
}

}  // namespace pleinair::tracker
#endif
