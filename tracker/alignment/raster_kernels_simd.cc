#include "tracker/alignment/raster_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/alignment/raster_kernels_simd.cc"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

// The same arithmetic as the scalar reference in raster_kernels.cc, in whole vectors.
HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<float, kRowSlack> kFloats;
const hn::Rebind<std::int32_t, decltype(kFloats)> kInts;
using Floats = hn::Vec<decltype(kFloats)>;
using Ints = hn::Vec<decltype(kInts)>;

void Map(const RayRow& rays, const float m[9], int count, const MapRow& out) {
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  const auto load = [](const float* from) { return hn::LoadU(kFloats, from); };
  const Floats m0 = hn::Set(kFloats, m[0]), m1 = hn::Set(kFloats, m[1]);
  const Floats m3 = hn::Set(kFloats, m[3]), m4 = hn::Set(kFloats, m[4]);
  const Floats m6 = hn::Set(kFloats, m[6]), m7 = hn::Set(kFloats, m[7]);
  const Floats one = hn::Set(kFloats, 1.0F), half = hn::Set(kFloats, 0.5F);
  const Floats origin_x = hn::Set(kFloats, rays.origin_x);
  const Floats origin_y = hn::Set(kFloats, rays.origin_y);
  for (int x = 0; x < count; x += lanes) {
    const float *qx = rays.x + x, *qy = rays.y + x;
    const Floats ix = hn::Sub(load(qx), origin_x), iy = hn::Sub(load(qy), origin_y);
    const auto form = [&](Floats a, Floats b, float c) {
      return hn::MulAdd(a, ix, hn::MulAdd(b, iy, hn::Set(kFloats, c)));
    };
    const Floats w = hn::Div(one, form(m6, m7, m[8]));
    const Floats column = hn::Mul(form(m0, m1, m[2]), w), row = hn::Mul(form(m3, m4, m[5]), w);
    const Floats half_w = hn::Mul(half, w);
    const Floats cx = hn::Mul(hn::NegMulAdd(m6, column, m0), half_w);
    const Floats cy = hn::Mul(hn::NegMulAdd(m7, column, m1), half_w);
    const Floats rx = hn::Mul(hn::NegMulAdd(m6, row, m3), half_w);
    const Floats ry = hn::Mul(hn::NegMulAdd(m7, row, m4), half_w);
    const Floats x_x = hn::Sub(load(qx + 1), load(qx - 1));
    const Floats y_x = hn::Sub(load(qy + 1), load(qy - 1));
    const Floats x_y = hn::Sub(load(qx + rays.stride), load(qx - rays.stride));
    const Floats y_y = hn::Sub(load(qy + rays.stride), load(qy - rays.stride));
    hn::StoreU(column, kFloats, out.column + x);
    hn::StoreU(row, kFloats, out.row + x);
    hn::StoreU(hn::MulAdd(cx, x_x, hn::Mul(cy, y_x)), kFloats, out.column_x + x);
    hn::StoreU(hn::MulAdd(cx, x_y, hn::Mul(cy, y_y)), kFloats, out.column_y + x);
    hn::StoreU(hn::MulAdd(rx, x_x, hn::Mul(ry, y_x)), kFloats, out.row_x + x);
    hn::StoreU(hn::MulAdd(rx, x_y, hn::Mul(ry, y_y)), kFloats, out.row_y + x);
  }
}

RowRanges Ranges(const MapRow& map, float modules, float near_px, float far_px, int count) {
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  const Floats all = hn::Set(kFloats, modules);
  const Floats near_reach = hn::Set(kFloats, near_px), far_reach = hn::Set(kFloats, far_px);
  RowRange near{count, 0}, far{count, 0};
  for (int x = 0; x < count; x += lanes) {
    const auto load = [&](const float* from) { return hn::LoadU(kFloats, from + x); };
    const auto step = [&](const float* by_x, const float* by_y) {
      return hn::Add(hn::Abs(load(by_x)), hn::Abs(load(by_y)));
    };
    const Floats column = load(map.column), row = load(map.row);
    const Floats column_step = step(map.column_x, map.column_y);
    const Floats row_step = step(map.row_x, map.row_y);
    const auto within = [&](Floats value, Floats reach) {
      return hn::And(hn::Gt(value, hn::Neg(reach)), hn::Lt(value, hn::Add(all, reach)));
    };
    const auto add = [&](Floats reach, RowRange* range) {
      const auto mask = hn::And(hn::And(within(column, hn::Mul(reach, column_step)),
                                        within(row, hn::Mul(reach, row_step))),
                                hn::FirstN(kFloats, static_cast<std::size_t>(count - x)));
      if (hn::AllFalse(kFloats, mask)) return false;
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(kFloats, mask, bits);
      const unsigned set = bits[0] | static_cast<unsigned>(bits[1]) << 8;
      if (range->end == 0) range->begin = x + __builtin_ctz(set);
      range->end = x + 32 - __builtin_clz(set);
      return true;
    };
    // If nothing is within the greater radius, nothing is within the smaller.
    if (add(far_reach, &far)) add(near_reach, &near);
  }
  return {near.end > 0 ? near : RowRange{}, far.end > 0 ? far : RowRange{}};
}

/// Computes the share of white in a box from the modules around a node. `s` and `t` are the parts
/// of the box right of and below the node. The four modules are bits 0, 1, 4, 5.
HWY_INLINE Floats Blend(Ints around, Floats s, Floats t) {
  const Floats rest = hn::Sub(hn::Set(kFloats, 1.0F), s);
  const auto if_bit = [&](std::int32_t bit, Floats value) {
    const auto is_white = hn::TestBit(around, hn::Set(kInts, bit));
    return hn::IfThenElseZero(hn::RebindMask(kFloats, is_white), value);
  };
  const Floats top = hn::Add(if_bit(1, rest), if_bit(2, s));
  const Floats bottom = hn::Add(if_bit(16, rest), if_bit(32, s));
  return hn::MulAdd(hn::Sub(bottom, top), t, top);
}

HWY_INLINE Floats Clamp(Floats value, Floats least, Floats most) {
  return hn::Min(hn::Max(value, least), most);
}

/// Square root of `bin2` over the length of (a, b).
HWY_INLINE Floats InverseLength(Floats a, Floats b, Floats bin2) {
  const Floats square =
      hn::Max(hn::Mul(hn::MulAdd(a, a, hn::Mul(b, b)), bin2), hn::Set(kFloats, kMinBox2_modules2));
  // One Newton step makes the estimate accurate to single precision.
  const Floats root = hn::ApproximateReciprocalSqrt(square);
  const Floats half_square = hn::Mul(hn::Set(kFloats, 0.5F), square);
  return hn::Mul(root, hn::NegMulAdd(hn::Mul(half_square, root), root, hn::Set(kFloats, 1.5F)));
}

/// `kPerPixel`: 0 if not known at compile time.
template <int kPerPixel>
HWY_INLINE void SampleTimes(const MapRow& map, const NodeTable& table, int any_per_pixel, int count,
                            std::ptrdiff_t stride, float* out) {
  const int per_pixel = kPerPixel > 0 ? kPerPixel : any_per_pixel;
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  const float bin = 1.0F / static_cast<float>(per_pixel);
  const Floats zero = hn::Zero(kFloats), one = hn::Set(kFloats, 1.0F);
  const Floats half = hn::Set(kFloats, 0.5F), four = hn::Set(kFloats, 4.0F);
  // This addition leaves the integer in the lowest bits: faster than a conversion.
  const Floats five = hn::Set(kFloats, 5.0F + 0x1.8p23F);
  const Ints low_bits = hn::Set(kInts, 31);
  const Floats last = hn::Set(kFloats, static_cast<float>(table.nodes - 1));
  const Floats nodes = hn::Set(kFloats, static_cast<float>(table.nodes));
  const Floats bin2 = hn::Set(kFloats, bin * bin);
  constexpr bool kNearCentre = kPerPixel > 0;
  const Floats steepest = hn::Set(kFloats, kNearCentre ? kMaxSlopeNearCentre : kMaxModule);
  const Floats downhill = hn::Neg(steepest);
  const auto* around = reinterpret_cast<const std::int32_t*>(table.around);
  const auto finite = [&](const float* from) {
    const Floats value = hn::LoadU(kFloats, from);
    return hn::IfThenElseZero(hn::Eq(value, value), value);
  };
  const auto lookup = [&](Floats row, Floats column) {
    return hn::GatherIndex(kInts, around, hn::ConvertTo(kInts, hn::MulAdd(row, nodes, column)));
  };
  for (int x = 0; x < count; x += lanes) {
    const Floats column = Clamp(finite(map.column + x), zero, last);
    const Floats row = Clamp(finite(map.row + x), zero, last);
    const Floats column_x = Clamp(finite(map.column_x + x), downhill, steepest);
    const Floats column_y = Clamp(finite(map.column_y + x), downhill, steepest);
    const Floats row_x = Clamp(finite(map.row_x + x), downhill, steepest);
    const Floats row_y = Clamp(finite(map.row_y + x), downhill, steepest);
    const Floats inverse_c = InverseLength(column_x, column_y, bin2);
    const Floats inverse_r = InverseLength(row_x, row_y, bin2);
    // From the node nearest to the pixel's centre; its modules contain those of the adjacent nodes.
    const Floats centre_c = hn::Round(column), centre_r = hn::Round(row);
    const Floats from_c = hn::Sub(column, centre_c), from_r = hn::Sub(row, centre_r);
    const Ints centre = lookup(centre_r, centre_c);
    const auto share = [&](Floats from_node, Floats inverse) {
      return Clamp(hn::MulAdd(from_node, inverse, half), zero, one);
    };
    float* to = out + x;
    for (int j = 0; j < per_pixel; ++j) {
      const Floats dy = hn::Set(kFloats, (static_cast<float>(j) + 0.5F) * bin - 0.5F);
      const Floats c_row = hn::MulAdd(column_y, dy, from_c), r_row = hn::MulAdd(row_y, dy, from_r);
      for (int i = 0; i < per_pixel; ++i, to += stride) {
        const Floats dx = hn::Set(kFloats, (static_cast<float>(i) + 0.5F) * bin - 0.5F);
        Floats c = hn::MulAdd(column_x, dx, c_row), r = hn::MulAdd(row_x, dx, r_row);
        Ints modules;
        if (kNearCentre) {
          const Floats right = hn::Round(c), down = hn::Round(r);
          const Floats shift = hn::MulAdd(down, four, hn::Add(right, five));
          modules = hn::Shr(centre, hn::And(hn::BitCast(kInts, shift), low_bits));
          c = hn::Sub(c, right);
          r = hn::Sub(r, down);
        } else {
          const Floats at_c = Clamp(hn::Add(c, centre_c), zero, last);
          const Floats at_r = Clamp(hn::Add(r, centre_r), zero, last);
          const Floats node_c = hn::Round(at_c), node_r = hn::Round(at_r);
          modules = hn::ShiftRight<5>(lookup(node_r, node_c));
          c = hn::Sub(at_c, node_c);
          r = hn::Sub(at_r, node_r);
        }
        hn::StoreU(Blend(modules, share(c, inverse_c), share(r, inverse_r)), kFloats, to);
      }
    }
  }
}

void Sample(const MapRow& map, const NodeTable& table, int per_pixel, int count,
            std::ptrdiff_t stride, float* out) {
  static_assert(kMaxSamplesNearCentre == 2);
  if (per_pixel == 1) {
    SampleTimes<1>(map, table, per_pixel, count, stride, out);
  } else if (per_pixel == 2) {
    SampleTimes<2>(map, table, per_pixel, count, stride, out);
  } else {
    SampleTimes<0>(map, table, per_pixel, count, stride, out);
  }
}

/// `kVectors` in parallel, so that each weight is loaded once.
template <int kVectors>
HWY_INLINE void RowVectors(const float* in, std::ptrdiff_t stride, const BlurTaps& taps,
                           float* blurred, float* blurred_x) {
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  Floats sum[kVectors], slope[kVectors];
  for (int v = 0; v < kVectors; ++v) sum[v] = slope[v] = hn::Zero(kFloats);
  for (int i = 0; i < taps.per_pixel; ++i) {
    const float* from = in + i * stride;
    for (int p = 0, k = i; p < taps.pixels; ++p, k += taps.per_pixel) {
      const Floats weight = hn::Set(kFloats, taps.weight[k]);
      const Floats weight_x = hn::Set(kFloats, taps.slope[k]);
      for (int v = 0; v < kVectors; ++v) {
        const Floats value = hn::LoadU(kFloats, from + p + v * lanes);
        sum[v] = hn::MulAdd(weight, value, sum[v]);
        slope[v] = hn::MulAdd(weight_x, value, slope[v]);
      }
    }
  }
  for (int v = 0; v < kVectors; ++v) {
    hn::StoreU(sum[v], kFloats, blurred + v * lanes);
    hn::StoreU(slope[v], kFloats, blurred_x + v * lanes);
  }
}

void AlongRow(const float* in, std::ptrdiff_t stride, const BlurTaps& taps, int count,
              float* blurred, float* blurred_x) {
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  int x = 0;
  for (; x + lanes < count; x += 2 * lanes) {
    RowVectors<2>(in + x, stride, taps, blurred + x, blurred_x + x);
  }
  if (x < count) RowVectors<1>(in + x, stride, taps, blurred + x, blurred_x + x);
}

void AlongColumn(const float* const* rows, const float* const* rows_x, const BlurTaps& taps,
                 int count, float* white, float* white_x, float* white_y) {
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  if (count < lanes) {
    ScalarRasterKernels().along_column(rows, rows_x, taps, count, white, white_x, white_y);
    return;
  }
  const int all = taps.pixels * taps.per_pixel;
  // Two vectors at a time, which share the weights; the last ones overlap the previous.
  for (int from = 0; from < count; from += 2 * lanes) {
    const int at[2] = {HWY_MIN(from, count - lanes), HWY_MIN(from + lanes, count - lanes)};
    Floats sum[2], sum_x[2], sum_y[2];
    for (int v = 0; v < 2; ++v) sum[v] = sum_x[v] = sum_y[v] = hn::Zero(kFloats);
    for (int k = 0; k < all; ++k) {
      const Floats weight = hn::Set(kFloats, taps.weight[k]);
      const Floats slope = hn::Set(kFloats, taps.slope[k]);
      for (int v = 0; v < 2; ++v) {
        const Floats value = hn::LoadU(kFloats, rows[k] + at[v]);
        sum[v] = hn::MulAdd(weight, value, sum[v]);
        sum_x[v] = hn::MulAdd(weight, hn::LoadU(kFloats, rows_x[k] + at[v]), sum_x[v]);
        sum_y[v] = hn::MulAdd(slope, value, sum_y[v]);
      }
    }
    for (int v = 0; v < 2; ++v) {
      hn::StoreU(sum[v], kFloats, white + at[v]);
      hn::StoreU(sum_x[v], kFloats, white_x + at[v]);
      hn::StoreU(sum_y[v], kFloats, white_y + at[v]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace pleinair::tracker
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {
HWY_EXPORT(Map);
HWY_EXPORT(Ranges);
HWY_EXPORT(Sample);
HWY_EXPORT(AlongRow);
HWY_EXPORT(AlongColumn);

const RasterKernels& SimdRasterKernels() {
  static const RasterKernels kKernels{
      [](const RayRow& rays, const float homography[9], int count, const MapRow& out) {
        HWY_DYNAMIC_DISPATCH(Map)(rays, homography, count, out);
      },
      [](const MapRow& map, float modules, float near_px, float far_px, int count) {
        return HWY_DYNAMIC_DISPATCH(Ranges)(map, modules, near_px, far_px, count);
      },
      [](const MapRow& map, const NodeTable& table, int per_pixel, int count, std::ptrdiff_t stride,
         float* out) {
        HWY_DYNAMIC_DISPATCH(Sample)
        (map, table, per_pixel, count, stride, out);
      },
      [](const float* in, std::ptrdiff_t stride, const BlurTaps& taps, int count, float* blurred,
         float* blurred_x) {
        HWY_DYNAMIC_DISPATCH(AlongRow)(in, stride, taps, count, blurred, blurred_x);
      },
      [](const float* const* rows, const float* const* rows_x, const BlurTaps& taps, int count,
         float* white, float* white_x, float* white_y) {
        HWY_DYNAMIC_DISPATCH(AlongColumn)
        (rows, rows_x, taps, count, white, white_x, white_y);
      }};
  return kKernels;
}

}  // namespace pleinair::tracker
#endif  // HWY_ONCE
