#include "tracker/surf/hessian_row.h"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/surf/hessian_row.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Differences of rows, so that each box below is one subtraction. [0]: D_xx. [1]: D_yy with three
/// times its middle lobe (weights 1, -2, 1). [2]: D_xy, upper minus lower boxes.
/// `rows` of the integral image: 0, 1 above and below the 2l - 1 rows of D_xx; 2, 3 above and below
/// D_yy and 4, 5 its middle lobe; 6, 7 above and below the upper boxes of D_xy and 8, 9 the lower.
void SubtractRows(const std::uint32_t* const* rows, int begin, int end,
                  std::int32_t* const* differences) {
  const hn::ScalableTag<std::uint32_t> du;
  const hn::RebindToSigned<decltype(du)> di;
  for (int x = begin; x < end; x += static_cast<int>(hn::Lanes(du))) {
    const auto at = [&](int k) { return hn::LoadU(du, rows[k] + x); };
    const auto xx = hn::Sub(at(1), at(0));
    const auto middle = hn::Sub(at(5), at(4));
    const auto yy = hn::Sub(hn::Sub(at(3), at(2)), hn::Add(middle, hn::ShiftLeft<1>(middle)));
    const auto xy = hn::Sub(hn::Sub(at(7), at(6)), hn::Sub(at(9), at(8)));
    hn::StoreU(hn::BitCast(di, xx), di, differences[0] + x);
    hn::StoreU(hn::BitCast(di, yy), di, differences[1] + x);
    hn::StoreU(hn::BitCast(di, xy), di, differences[2] + x);
  }
}

/// Sorts a row by x modulo `step` (2 or 4): phase p is at phases + p * phase_stride. Samples that
/// are `step` apart in the image are then adjacent.
void SplitPhases(const std::int32_t* row, int count, int step, std::ptrdiff_t phase_stride,
                 std::int32_t* phases) {
  const hn::ScalableTag<std::int32_t> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  using V = hn::Vec<decltype(d)>;
  if (step == 2) {
    for (int i = 0; i * 2 < count; i += lanes) {
      V p0, p1;
      hn::LoadInterleaved2(d, row + i * 2, p0, p1);
      hn::StoreU(p0, d, phases + i);
      hn::StoreU(p1, d, phases + phase_stride + i);
    }
    return;
  }
  for (int i = 0; i * 4 < count; i += lanes) {
    V p0, p1, p2, p3;
    hn::LoadInterleaved4(d, row + i * 4, p0, p1, p2, p3);
    hn::StoreU(p0, d, phases + i);
    hn::StoreU(p1, d, phases + phase_stride + i);
    hn::StoreU(p2, d, phases + 2 * phase_stride + i);
    hn::StoreU(p3, d, phases + 3 * phase_stride + i);
  }
}

/// Computes the determinants of samples begin..end - 1.
/// `edges`, the differences above from sample 0 on: 0, 1 left and right of D_xx and 2, 3 of its
/// middle lobe; 4, 5 left and right of D_yy; 6, 7 left and right of the left boxes of D_xy and 8, 9
/// of the right.
void Determinants(const std::int32_t* const* edges, int begin, int end, float inverse_area,
                  float* responses) {
  const hn::ScalableTag<float> df;
  const hn::RebindToSigned<decltype(df)> di;
  const auto scale = hn::Set(df, inverse_area);
  const auto mixed_scale = hn::Set(df, inverse_area * kMixedDerivativeWeight);
  for (int i = begin; i < end; i += static_cast<int>(hn::Lanes(df))) {
    const auto at = [&](int k) { return hn::LoadU(di, edges[k] + i); };
    const auto middle = hn::Sub(at(3), at(2));
    const auto xx = hn::Sub(hn::Sub(at(1), at(0)), hn::Add(middle, hn::ShiftLeft<1>(middle)));
    const auto yy = hn::Sub(at(5), at(4));
    const auto xy = hn::Sub(hn::Sub(at(7), at(6)), hn::Sub(at(9), at(8)));
    const auto dxx = hn::Mul(hn::ConvertTo(df, xx), scale);
    const auto dyy = hn::Mul(hn::ConvertTo(df, yy), scale);
    const auto dxy = hn::Mul(hn::ConvertTo(df, xy), mixed_scale);
    hn::StoreU(hn::NegMulAdd(dxy, dxy, hn::Mul(dxx, dyy)), df, responses + i);
  }
}

}  // namespace
}  // namespace pleinair::tracker::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {

namespace {

HWY_EXPORT(SubtractRows);
HWY_EXPORT(SplitPhases);
HWY_EXPORT(Determinants);

/// Grows, never shrinks: filters and octaves share the memory. The result is aligned to a cache
/// line.
std::int32_t* AtLeast(std::size_t size, std::vector<std::int32_t>* values) {
  constexpr std::uintptr_t kLine = 64;
  if (values->size() < size + kLine) values->resize(size + kLine);
  const auto address = reinterpret_cast<std::uintptr_t>(values->data());
  return values->data() + (kLine - address % kLine) % kLine / sizeof(std::int32_t);
}

/// Row differences at an x-offset from sample i = 0, in the sorted phases, with samples `step` = 1,
/// 2 or 4 apart.
const std::int32_t* EdgeAt(const std::int32_t* phases, std::ptrdiff_t phase_stride, int step,
                           int offset) {
  const int phase = offset & (step - 1);
  return phases + phase * phase_stride + ((offset - phase) >> (step >> 1));
}

}  // namespace

void ComputeHessianRow(const IntegralImage& integral, int filter_size, int step, int y,
                       SampleRange samples, HessianScratch* scratch, float* responses) {
  const int width = integral.width();
  const int margin = filter_size / 2;
  const int lobe = filter_size / 3;
  // Samples whose filter is inside the image.
  const int inside = width - 1 - margin < 0 ? 0 : (width - 1 - margin) / step + 1;
  const int begin = std::max(samples.first, (margin + step - 1) / step);
  const int end = std::min(samples.last, inside);
  if (y < margin || y + margin >= integral.height() || begin >= end) {
    std::fill(responses + samples.first, responses + samples.last, 0.0f);
    return;
  }

  const int half_lobe = (lobe - 1) / 2;
  const auto row = [&](int dy) { return integral.row(y + dy); };
  const std::array<const std::uint32_t*, 10> rows = {
      row(1 - lobe), row(lobe),                                             // D_xx
      row(-margin),  row(margin + 1), row(-half_lobe), row(half_lobe + 1),  // D_yy
      row(-lobe),    row(0),          row(1),          row(lobe + 1)};      // D_xy
  // Whole vectors of the row, from the start of the first filter to the end of the last one.
  constexpr int kVector = 16;
  const int from = (begin * step - margin) / kVector * kVector;
  const int to = (end - 1) * step + margin + 2;
  // Room for whole vectors at the end of the row and of each phase.
  const std::size_t row_size = width + 1 + 4 * IntegralImage::kPadding;
  std::int32_t* differences[3];
  for (int k = 0; k < 3; ++k) differences[k] = AtLeast(row_size, &scratch->differences[k]);
  HWY_DYNAMIC_DISPATCH(SubtractRows)(rows.data(), from, to, differences);

  std::ptrdiff_t phase_stride = 0;
  if (step > 1) {
    phase_stride = (width + 1) / step + 1 + IntegralImage::kPadding;
    for (int k = 0; k < 3; ++k) {
      std::int32_t* phases = AtLeast(phase_stride * step, &scratch->phases[k]);
      HWY_DYNAMIC_DISPATCH(SplitPhases)
      (differences[k] + from, to - from, step, phase_stride, phases + from / step);
      differences[k] = phases;
    }
  }
  const auto edge = [&](int k, int dx) { return EdgeAt(differences[k], phase_stride, step, dx); };
  const std::array<const std::int32_t*, 10> edges = {
      edge(0, -margin),  edge(0, margin + 1), edge(0, -half_lobe), edge(0, half_lobe + 1),  // D_xx
      edge(1, 1 - lobe), edge(1, lobe),                                                     // D_yy
      edge(2, -lobe),    edge(2, 0),          edge(2, 1),          edge(2, lobe + 1)};      // D_xy
  const float area = static_cast<float>(filter_size) * static_cast<float>(filter_size);
  HWY_DYNAMIC_DISPATCH(Determinants)(edges.data(), begin, end, 1.0f / (255.0f * area), responses);
  std::fill(responses + samples.first, responses + begin, 0.0f);
  std::fill(responses + end, responses + samples.last, 0.0f);
}

float LaplacianAt(const IntegralImage& integral, int filter_size, int x, int y) {
  const int margin = filter_size / 2;
  const int lobe = filter_size / 3;
  const int half_lobe = (lobe - 1) / 2;
  const auto sum = [&](int x0, int y0, int x1, int y1) {
    return static_cast<float>(integral.BoxSum(x + x0, y + y0, x + x1, y + y1));
  };
  const float xx =
      sum(-margin, 1 - lobe, margin + 1, lobe) - 3 * sum(-half_lobe, 1 - lobe, half_lobe + 1, lobe);
  const float yy =
      sum(1 - lobe, -margin, lobe, margin + 1) - 3 * sum(1 - lobe, -half_lobe, lobe, half_lobe + 1);
  return (xx + yy) / (255.0f * static_cast<float>(filter_size) * static_cast<float>(filter_size));
}

}  // namespace pleinair::tracker
#endif
