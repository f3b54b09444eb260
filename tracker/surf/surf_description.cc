#include "tracker/surf/surf_description.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tracker/surf/patch_sampler.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/surf/surf_description.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PLEINAIR_TRACKER_SURF_DESCRIPTOR_GRID
#define PLEINAIR_TRACKER_SURF_DESCRIPTOR_GRID
namespace pleinair::tracker {
namespace {
constexpr int kCells = 4;                        ///< In each direction.
constexpr int kCellSamples = 5;                  ///< In each direction.
constexpr int kSamples = kCells * kCellSamples;  ///< In each direction.
constexpr int kColumns = 24;                     ///< Row stride of boxes and samples in memory.
constexpr int kBoxes = 512;  ///< (kSamples + 1) rows, and some to fill whole vectors.
constexpr int kChannels = 4;
constexpr int kReach = kCellSamples / 2;  ///< Samples by which a cell extends beyond its own.

/// Weight in a cell of sample `i` of a row or column, counted from the cell's first: 1 at the
/// cell's centre, 0 at the centre of the next.
constexpr float CellWeight(int i) {
  const int from_middle = i < kReach ? kReach - i : i - kReach;
  return 1.0f - static_cast<float>(from_middle) / kCellSamples;
}
}  // namespace
}  // namespace pleinair::tracker
#endif

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// sums[(band * kColumns + column) * kChannels + channel], over the rows of samples that extend
/// into each band of cells.
void SumBands(const float* boxes, const float* weights, float* sums) {
  const hn::CappedTag<float, 8> df;
  for (int band = 0; band < kCells; ++band) {
    const int first_row = HWY_MAX(0, band * kCellSamples - kReach);
    const int last_row = HWY_MIN(kSamples, (band + 1) * kCellSamples + kReach) - 1;
    for (int column = 0; column < kColumns; column += static_cast<int>(hn::Lanes(df))) {
      auto sum_x = hn::Zero(df), sum_y = hn::Zero(df);
      auto sum_abs_x = hn::Zero(df), sum_abs_y = hn::Zero(df);
      for (int row = first_row; row <= last_row; ++row) {
        const int i = row * kColumns + column;
        const auto falling =
            hn::Sub(hn::LoadU(df, boxes + i + kColumns + 1), hn::LoadU(df, boxes + i));
        const auto rising =
            hn::Sub(hn::LoadU(df, boxes + i + 1), hn::LoadU(df, boxes + i + kColumns));
        const auto weight =
            hn::Mul(hn::LoadU(df, weights + i), hn::Set(df, CellWeight(row - band * kCellSamples)));
        const auto x = hn::Mul(hn::Add(falling, rising), weight);
        const auto y = hn::Mul(hn::Sub(falling, rising), weight);
        sum_x = hn::Add(sum_x, x);
        sum_y = hn::Add(sum_y, y);
        sum_abs_x = hn::Add(sum_abs_x, hn::Abs(x));
        sum_abs_y = hn::Add(sum_abs_y, hn::Abs(y));
      }
      hn::StoreInterleaved4(sum_x, sum_y, sum_abs_x, sum_abs_y, df,
                            sums + (band * kColumns + column) * kChannels);
    }
  }
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {

HWY_EXPORT(SumBands);

struct DescriptorTables {
  std::array<float, kBoxes> columns, rows;
  std::array<float, kSamples* kColumns> weights = {};

  DescriptorTables() {
    constexpr float kMiddle = kSamples / 2.0f;
    for (int i = 0; i < kBoxes; ++i) {
      columns[i] = static_cast<float>(i % kColumns) - kMiddle;
      const int row = i / kColumns;
      rows[i] = static_cast<float>(row) - kMiddle;
    }
    constexpr float kSigma = 3.3f;  // Section 4.2, in scales.
    for (int row = 0; row < kSamples; ++row) {
      for (int column = 0; column < kSamples; ++column) {
        const float x = static_cast<float>(column) + 0.5f - kMiddle;
        const float y = static_cast<float>(row) + 0.5f - kMiddle;
        weights[row * kColumns + column] = std::exp(-(x * x + y * y) / (2 * kSigma * kSigma));
      }
    }
  }
};

}  // namespace

SurfDescriptor DescribeKeypoint(BoxLevels* levels, const SurfKeypoint& keypoint,
                                float window_scales) {
  static const DescriptorTables tables;
  const float spacing = keypoint.scale * window_scales / kSamples;
  const float c = spacing * std::cos(keypoint.angle_rad);
  const float s = spacing * std::sin(keypoint.angle_rad);
  alignas(64) float boxes[kBoxes];
  SamplePatch(
      levels->Nearest(spacing),
      {.x = keypoint.x, .y = keypoint.y, .right_x = c, .right_y = s, .down_x = -s, .down_y = c},
      tables.columns.data(), tables.rows.data(), kBoxes, boxes);
  alignas(64) float sums[kCells * kChannels * kColumns];
  HWY_DYNAMIC_DISPATCH(SumBands)(boxes, tables.weights.data(), sums);

  SurfDescriptor descriptor = {};
  for (int band = 0; band < kCells; ++band) {
    for (int cell = 0; cell < kCells; ++cell) {
      const int first = cell * kCellSamples;
      const int begin = std::max(0, first - kReach);
      const int end = std::min(kSamples, first + kCellSamples + kReach);
      float* const values = descriptor.data() + (band * kCells + cell) * kChannels;
      for (int column = begin; column < end; ++column) {
        const float weight = CellWeight(column - first);
        for (int channel = 0; channel < kChannels; ++channel) {
          values[channel] += weight * sums[(band * kColumns + column) * kChannels + channel];
        }
      }
    }
  }
  float squared_length = 0;
  for (const float value : descriptor) squared_length += value * value;
  const float per_length = squared_length > 0 ? 1 / std::sqrt(squared_length) : 0;
  for (float& value : descriptor) value *= per_length;
  return descriptor;
}

}  // namespace pleinair::tracker
#endif
