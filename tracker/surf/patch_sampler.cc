#include "tracker/surf/patch_sampler.h"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/surf/patch_sampler.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// `grid` is in elements of the level. Two neighbours in a row are loaded together.
void Sample(const BoxLevel& level, const PatchGrid& grid, const float* columns, const float* rows,
            int count, float* values) {
  const hn::CappedTag<float, 16> df;
  const hn::RebindToSigned<decltype(df)> di;
  const auto x0 = hn::Set(df, grid.x), y0 = hn::Set(df, grid.y);
  const auto right_x = hn::Set(df, grid.right_x), right_y = hn::Set(df, grid.right_y);
  const auto down_x = hn::Set(df, grid.down_x), down_y = hn::Set(df, grid.down_y);
  const auto last_x = hn::Set(df, static_cast<float>(level.width - 1));
  const auto last_y = hn::Set(df, static_cast<float>(level.height - 1));
  const auto row_bytes = hn::Set(di, static_cast<std::int32_t>(level.stride * 2));
  const auto low_half = hn::Set(di, 0xffff);
  const auto* const base = reinterpret_cast<const std::int32_t*>(level.means.data());
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(df))) {
    const auto column = hn::LoadU(df, columns + i);
    const auto row = hn::LoadU(df, rows + i);
    auto x = hn::MulAdd(column, right_x, hn::MulAdd(row, down_x, x0));
    auto y = hn::MulAdd(column, right_y, hn::MulAdd(row, down_y, y0));
    x = hn::Min(hn::Max(x, hn::Zero(df)), last_x);
    y = hn::Min(hn::Max(y, hn::Zero(df)), last_y);
    const auto whole_x = hn::ConvertTo(di, x);
    const auto whole_y = hn::ConvertTo(di, y);
    const auto fraction_x = hn::Sub(x, hn::ConvertTo(df, whole_x));
    const auto fraction_y = hn::Sub(y, hn::ConvertTo(df, whole_y));
    const auto offset = hn::Add(hn::Mul(whole_y, row_bytes), hn::ShiftLeft<1>(whole_x));
    const auto upper = hn::GatherOffset(di, base, offset);
    const auto lower = hn::GatherOffset(di, base, hn::Add(offset, row_bytes));
    const auto interpolate_x = [&](auto pair) {
      const auto left = hn::ConvertTo(df, hn::And(pair, low_half));
      const auto right = hn::ConvertTo(
          df, hn::BitCast(
                  di, hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<decltype(di)>(), pair))));
      return hn::MulAdd(hn::Sub(right, left), fraction_x, left);
    };
    const auto top = interpolate_x(upper);
    const auto bottom = interpolate_x(lower);
    hn::StoreU(hn::MulAdd(hn::Sub(bottom, top), fraction_y, top), df, values + i);
  }
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {
HWY_EXPORT(Sample);
}  // namespace

void SamplePatch(const BoxLevel& level, const PatchGrid& grid, const float* columns,
                 const float* rows, int count, float* values) {
  const float per_px = 1.0f / static_cast<float>(level.step);
  const float first_centre = static_cast<float>(level.box - 1) / 2;
  const PatchGrid in_elements = {
      .x = (grid.x - first_centre) * per_px,
      .y = (grid.y - first_centre) * per_px,
      .right_x = grid.right_x * per_px,
      .right_y = grid.right_y * per_px,
      .down_x = grid.down_x * per_px,
      .down_y = grid.down_y * per_px,
  };
  HWY_DYNAMIC_DISPATCH(Sample)(level, in_elements, columns, rows, count, values);
}

}  // namespace pleinair::tracker
#endif
