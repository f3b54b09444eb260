#include "tracker/surf/surf_orientation.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "tracker/surf/patch_sampler.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/surf/surf_orientation.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PLEINAIR_TRACKER_SURF_ORIENTATION_GRID
#define PLEINAIR_TRACKER_SURF_ORIENTATION_GRID
namespace pleinair::tracker {
namespace {
constexpr int kRadius = 6;    ///< In scales.
constexpr int kColumns = 16;  ///< Row stride of boxes and wavelets in memory.
constexpr int kBoxes = (2 * kRadius + 3) * kColumns;  ///< One more than wavelets on each side.
constexpr int kWavelets = (2 * kRadius + 1) * kColumns;
constexpr float kSigma = 2.5f;      ///< Of the weights, in scales.
constexpr int kBins = 72;           ///< Bins of 5 degrees.
constexpr int kWindow = kBins / 2;  ///< Half a turn.
}  // namespace
}  // namespace pleinair::tracker
#endif

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Computes the weighted responses of the wavelets, and the direction bin of each.
void Wavelets(const float* boxes, const float* weights, float* dx, float* dy, std::int32_t* bins) {
  const hn::CappedTag<float, 16> df;
  const hn::RebindToSigned<decltype(df)> di;
  for (int i = 0; i < kWavelets; i += static_cast<int>(hn::Lanes(df))) {
    const auto top_left = hn::LoadU(df, boxes + i);
    const auto top_right = hn::LoadU(df, boxes + i + 2);
    const auto bottom_left = hn::LoadU(df, boxes + i + 2 * kColumns);
    const auto bottom_right = hn::LoadU(df, boxes + i + 2 * kColumns + 2);
    const auto falling = hn::Sub(bottom_right, top_left);
    const auto rising = hn::Sub(top_right, bottom_left);
    const auto weight = hn::LoadU(df, weights + i);
    const auto x = hn::Mul(hn::Add(falling, rising), weight);
    const auto y = hn::Mul(hn::Sub(falling, rising), weight);
    hn::StoreU(x, df, dx + i);
    hn::StoreU(y, df, dy + i);

    // Arctangent in the first octant: Abramowitz and Stegun, 4.4.49, error below 1e-5 rad.
    const auto abs_x = hn::Abs(x), abs_y = hn::Abs(y);
    const auto larger = hn::Max(abs_x, abs_y);
    const auto tiny = hn::Set(df, 1e-20f);  // Avoids 0 / 0; no response is that small.
    const auto t = hn::Div(hn::Min(abs_x, abs_y), hn::Max(larger, tiny));
    const auto t2 = hn::Mul(t, t);
    auto series = hn::MulAdd(t2, hn::Set(df, 0.0208351f), hn::Set(df, -0.0851330f));
    series = hn::MulAdd(t2, series, hn::Set(df, 0.1801410f));
    series = hn::MulAdd(t2, series, hn::Set(df, -0.3302995f));
    series = hn::MulAdd(t2, series, hn::Set(df, 0.9998660f));
    // In bins, extended to the full turn.
    auto turn = hn::Mul(hn::Mul(t, series), hn::Set(df, kBins / 6.2831853f));
    turn = hn::IfThenElse(hn::Gt(abs_y, abs_x), hn::Sub(hn::Set(df, kBins / 4.0f), turn), turn);
    turn = hn::IfThenElse(hn::Lt(x, hn::Zero(df)), hn::Sub(hn::Set(df, kBins / 2.0f), turn), turn);
    turn = hn::IfThenElse(hn::Lt(y, hn::Zero(df)), hn::Sub(hn::Set(df, kBins), turn), turn);
    hn::StoreU(hn::Min(hn::ConvertTo(di, turn), hn::Set(di, kBins - 1)), di, bins + i);
  }
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {

HWY_EXPORT(Wavelets);

struct OrientationTables {
  std::array<float, kBoxes> columns, rows;
  std::array<float, kWavelets> weights;
  std::array<std::int32_t, 113> in_circle;  ///< The wavelets within the radius.

  OrientationTables() {
    for (int i = 0; i < kBoxes; ++i) {
      columns[i] = static_cast<float>(i % kColumns - kRadius - 1);
      const int row = i / kColumns;
      rows[i] = static_cast<float>(row - kRadius - 1);
    }
    int used = 0;
    for (int i = 0; i < kWavelets; ++i) {
      const int x = i % kColumns - kRadius;
      const int y = i / kColumns - kRadius;
      weights[i] = std::exp(static_cast<float>(-(x * x + y * y)) / (2 * kSigma * kSigma));
      if (x * x + y * y <= kRadius * kRadius) in_circle[used++] = i;
    }
  }
};

}  // namespace

float DominantDirection(BoxLevels* levels, float x, float y, float scale) {
  static const OrientationTables tables;
  alignas(64) float boxes[kBoxes + kColumns] = {};
  SamplePatch(levels->Nearest(2 * scale), {.x = x, .y = y, .right_x = scale, .down_y = scale},
              tables.columns.data(), tables.rows.data(), kBoxes, boxes);
  alignas(64) float dx[kWavelets];
  alignas(64) float dy[kWavelets];
  alignas(64) std::int32_t bins[kWavelets];
  HWY_DYNAMIC_DISPATCH(Wavelets)(boxes, tables.weights.data(), dx, dy, bins);

  // Prefix sums of the bins over one turn plus a window: each window is a difference of two sums.
  float bin_x[kBins] = {};
  float bin_y[kBins] = {};
  for (const std::int32_t i : tables.in_circle) {
    bin_x[bins[i]] += dx[i];
    bin_y[bins[i]] += dy[i];
  }
  float sum_x[kBins + kWindow + 1] = {};
  float sum_y[kBins + kWindow + 1] = {};
  for (int k = 0; k < kBins + kWindow; ++k) {
    sum_x[k + 1] = sum_x[k] + bin_x[k % kBins];
    sum_y[k + 1] = sum_y[k] + bin_y[k % kBins];
  }
  float longest = 0;
  float direction_x = 0;
  float direction_y = 0;
  for (int first = 0; first < kBins; ++first) {
    const float window_x = sum_x[first + kWindow] - sum_x[first];
    const float window_y = sum_y[first + kWindow] - sum_y[first];
    const float length = window_x * window_x + window_y * window_y;
    if (length > longest) {
      longest = length;
      direction_x = window_x;
      direction_y = window_y;
    }
  }
  return std::atan2(direction_y, direction_x);
}

}  // namespace pleinair::tracker
#endif
