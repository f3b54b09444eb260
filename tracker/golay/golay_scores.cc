#include "tracker/golay/golay_scores.h"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/golay/golay_scores.cc"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

// Shared by all SIMD targets.
#ifndef PLEINAIR_TRACKER_GOLAY_SCORES_SHARED
#define PLEINAIR_TRACKER_GOLAY_SCORES_SHARED
namespace pleinair::tracker {
namespace {

// A number is n = 64 l + h. Bit i of its word is <h, low_i> + <l, high_i> over GF(2), where low_i
// and high_i are the halves of column i of the generator. For a fixed h the sum over i is therefore
// a Hadamard transform over l of 24 signed weights. Vectors run over h, where all operations are
// the same.
constexpr int kSide = 64;

struct GeneratorColumns {
  std::array<int, kGolayBits> high{};
  /// For each h: -1 if the transform negates the weight of a bit, else 0.
  std::array<std::array<std::int32_t, kSide>, kGolayBits> sign{};
};

}  // namespace
}  // namespace pleinair::tracker
#endif

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<std::int32_t, kSide> kInts;
using Ints = hn::Vec<decltype(kInts)>;

/// Eight-point Hadamard transform.
HWY_INLINE void Butterfly8(Ints v[8]) {
  for (int half = 1; half < 8; half *= 2) {
    for (int i = 0; i < 8; ++i) {
      if ((i & half) != 0) continue;
      const Ints sum = hn::Add(v[i], v[i | half]);
      v[i | half] = hn::Sub(v[i], v[i | half]);
      v[i] = sum;
    }
  }
}

/// Transforms the 64 vectors `column[64 l]` over l.
HWY_INLINE void Transform64(std::int32_t* column) {
  for (const int step : {1, 8}) {
    for (int group = 0; group < 8; ++group) {
      std::int32_t* first = column + kSide * (step == 1 ? 8 * group : group);
      Ints v[8];
      for (int i = 0; i < 8; ++i) v[i] = hn::LoadU(kInts, first + kSide * step * i);
      Butterfly8(v);
      for (int i = 0; i < 8; ++i) hn::StoreU(v[i], kInts, first + kSide * step * i);
    }
  }
}

void Score(const GeneratorColumns& columns, const std::int32_t* weights, std::int32_t* scores) {
  std::fill_n(scores, kGolayNumbers, 0);
  for (int h = 0; h < kSide; h += static_cast<int>(hn::Lanes(kInts))) {
    for (int i = 0; i < kGolayBits; ++i) {
      std::int32_t* row = scores + kSide * columns.high[i] + h;
      const Ints sign = hn::LoadU(kInts, columns.sign[i].data() + h);  // -1 or 0.
      const Ints weight = hn::Set(kInts, weights[i]);
      hn::StoreU(hn::Add(hn::LoadU(kInts, row), hn::Sub(hn::Xor(weight, sign), sign)), kInts, row);
    }
    Transform64(scores + h);
  }
}

TopTwoScores TopTwo(const std::int32_t* scores) {
  constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
  Ints best = hn::Set(kInts, kMin), second = best;
  const int lanes = static_cast<int>(hn::Lanes(kInts));
  for (int n = 0; n < kGolayNumbers; n += lanes) {
    const Ints score = hn::LoadU(kInts, scores + n);
    second = hn::Max(second, hn::Min(best, score));
    best = hn::Max(best, score);
  }
  std::int32_t lane_best[kSide], lane_second[kSide];
  hn::StoreU(best, kInts, lane_best);
  hn::StoreU(second, kInts, lane_second);
  TopTwoScores top{lane_best[0], lane_second[0]};
  for (int i = 1; i < lanes; ++i) {
    top.second = std::max({std::min(top.best, lane_best[i]), top.second, lane_second[i]});
    top.best = std::max(top.best, lane_best[i]);
  }
  return top;
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {
namespace {

HWY_EXPORT(Score);
HWY_EXPORT(TopTwo);

GeneratorColumns MakeColumns() {
  GeneratorColumns columns;
  for (int i = 0; i < kGolayBits; ++i) {
    unsigned column = 0;
    for (int row = 0; row < 12; ++row) column |= (EncodeGolay(1 << row) >> i & 1U) << row;
    const unsigned low = column % kSide;
    columns.high[i] = static_cast<int>(column / kSide);
    for (unsigned h = 0; h < kSide; ++h) {
      // The transform adds a weight where the word has a 0; scores add it where it has a 1.
      columns.sign[i][h] = std::popcount(h & low) % 2 == 0 ? -1 : 0;
    }
  }
  return columns;
}

}  // namespace

void ScoreGolayWords(const std::array<std::int32_t, kGolayBits>& weights, GolayScores& scores) {
  static const GeneratorColumns columns = MakeColumns();
  HWY_DYNAMIC_DISPATCH(Score)(columns, weights.data(), scores.data());
}

TopTwoScores FindTopTwo(const GolayScores& scores) {
  return HWY_DYNAMIC_DISPATCH(TopTwo)(scores.data());
}

}  // namespace pleinair::tracker
#endif  // HWY_ONCE
