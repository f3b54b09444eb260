#include "tracker/surf/response_maxima.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/surf/response_maxima.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

int FindMaxima(const ResponseNeighbourhood& neighbourhood, int begin, int end, float threshold,
               std::int32_t* maxima) {
  const hn::ScalableTag<float> df;
  const hn::RebindToSigned<decltype(df)> di;
  const int lanes = static_cast<int>(hn::Lanes(df));
  const auto limit = hn::Set(df, threshold);
  const float* const middle = neighbourhood.rows[1][1];
  int count = 0;
  for (int i = begin; i < end; i += lanes) {
    const auto value = hn::LoadU(df, middle + i);
    auto is_maximum = hn::And(hn::Gt(value, limit), hn::FirstN(df, end - i));
    if (hn::AllFalse(df, is_maximum)) continue;
    // Strictly above the earlier neighbours, not below the later ones.
    const auto max_of_row = [&](const float* row) {
      return hn::Max(hn::Max(hn::LoadU(df, row + i - 1), hn::LoadU(df, row + i)),
                     hn::LoadU(df, row + i + 1));
    };
    const auto before =
        hn::Max(max_of_row(neighbourhood.rows[1][0]), hn::LoadU(df, middle + i - 1));
    const auto after = hn::Max(max_of_row(neighbourhood.rows[1][2]), hn::LoadU(df, middle + i + 1));
    is_maximum = hn::And(is_maximum, hn::And(hn::Gt(value, before), hn::Ge(value, after)));
    if (hn::AllFalse(df, is_maximum)) continue;
    const auto max_of_layer = [&](const float* const* rows) {
      return hn::Max(hn::Max(max_of_row(rows[0]), max_of_row(rows[1])), max_of_row(rows[2]));
    };
    is_maximum = hn::And(is_maximum, hn::Gt(value, max_of_layer(neighbourhood.rows[0])));
    is_maximum = hn::And(is_maximum, hn::Ge(value, max_of_layer(neighbourhood.rows[2])));
    count += static_cast<int>(
        hn::CompressStore(hn::Iota(di, i), hn::RebindMask(di, is_maximum), di, maxima + count));
  }
  return count;
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {
HWY_EXPORT(FindMaxima);
}  // namespace

int FindResponseMaxima(const ResponseNeighbourhood& neighbourhood, int begin, int end,
                       float threshold, std::int32_t* maxima) {
  return HWY_DYNAMIC_DISPATCH(FindMaxima)(neighbourhood, begin, end, threshold, maxima);
}

}  // namespace pleinair::tracker
#endif
