#include "tracker/alignment/tile_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/alignment/tile_kernels_simd.cc"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

// The same arithmetic as the scalar reference in tile_kernels.cc, in whole vectors; the last vector
// of a row overlaps the previous one.
HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

const hn::CappedTag<float, 16> kFloats;
using Floats = hn::Vec<decltype(kFloats)>;

HWY_INLINE Floats Load(const float* from) { return hn::LoadU(kFloats, from); }

void Mark(const MapOfRow& map, const KnownPart& known, const float* inverse_variance, int count,
          float* usable) {
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  if (count < lanes) {
    ScalarTileKernels().mark(map, known, inverse_variance, count, usable);
    return;
  }
  const Floats most = hn::Set(kFloats, known.max_reach_modules);
  const Floats reach = hn::Set(kFloats, known.reach_px);
  const Floats modules = hn::Set(kFloats, known.modules);
  const Floats middle = hn::Set(kFloats, known.unknown_middle);
  const Floats half = hn::Set(kFloats, known.unknown_half);
  const Floats blurred = hn::Set(kFloats, 0.8F), none = hn::Set(kFloats, -1.0F);
  for (int from = 0; from < count; from += lanes) {
    const int x = HWY_MIN(from, count - lanes);
    const auto far = [&](const float* at_x, const float* at_y) {
      return hn::Min(hn::Mul(reach, hn::Add(hn::Abs(Load(at_x + x)), hn::Abs(Load(at_y + x)))),
                     most);
    };
    const auto inside = [&](Floats at, Floats r) {
      return hn::And(hn::Gt(at, r), hn::Lt(at, hn::Sub(modules, r)));
    };
    const auto unknown = [&](Floats at, Floats r) {
      return hn::Lt(hn::Abs(hn::Sub(at, middle)), hn::MulAdd(blurred, r, half));
    };
    const Floats c = Load(map.column + x), r = Load(map.row + x);
    const Floats rc = far(map.column_x, map.column_y), rr = far(map.row_x, map.row_y);
    const auto known_here =
        hn::AndNot(hn::And(unknown(c, rc), unknown(r, rr)), hn::And(inside(c, rc), inside(r, rr)));
    hn::StoreU(hn::IfThenElse(known_here, Load(inverse_variance + x), none), kFloats, usable + x);
  }
}

HWY_INLINE Floats RobustWeight(Floats z) {
  const Floats one = hn::Set(kFloats, 1.0F);
  const Floats kept = hn::Div(one, hn::MulAdd(z, z, one));
  return hn::Mul(kept, kept);
}

void Levels(const PixelRows& rows, const LightOfColumns& light, std::ptrdiff_t sums_stride,
            float* sums) {
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  if (rows.count < lanes) {
    ScalarTileKernels().levels(rows, light, sums_stride, sums);
    return;
  }
  const Floats zero = hn::Zero(kFloats), one = hn::Set(kFloats, 1.0F);
  for (int from = 0; from < rows.count; from += lanes) {
    const int x = HWY_MIN(from, rows.count - lanes);
    const Floats gain = Load(light.gain + x), offset = Load(light.offset + x);
    const Floats inverse = Load(light.inverse + x);
    Floats pixels = zero, w1 = zero, wp = zero, wi = zero, wpp = zero, wpi = zero, wii = zero;
    Floats r1 = zero, rp = zero, ri = zero, rpp = zero, rpi = zero;
    for (int y = 0; y < rows.rows; ++y) {
      const std::ptrdiff_t at = y * rows.stride + x;
      const Floats usable = Load(rows.usable + at);
      const Floats p = Load(rows.white + at), i = Load(rows.value + at);
      const Floats w = hn::Max(usable, zero);
      const Floats z = hn::Mul(hn::NegMulAdd(gain, p, hn::Sub(i, offset)), inverse);
      const Floats r = hn::Mul(w, RobustWeight(z));
      const Floats w_p = hn::Mul(w, p), w_i = hn::Mul(w, i);
      const Floats r_p = hn::Mul(r, p);
      pixels = hn::Add(pixels, hn::IfThenElseZero(hn::Ge(usable, zero), one));
      w1 = hn::Add(w1, w);
      wp = hn::Add(wp, w_p);
      wi = hn::Add(wi, w_i);
      wpp = hn::MulAdd(w_p, p, wpp);
      wpi = hn::MulAdd(w_p, i, wpi);
      wii = hn::MulAdd(w_i, i, wii);
      r1 = hn::Add(r1, r);
      rp = hn::Add(rp, r_p);
      ri = hn::MulAdd(r, i, ri);
      rpp = hn::MulAdd(r_p, p, rpp);
      rpi = hn::MulAdd(r_p, i, rpi);
    }
    float* to = sums + x;
    for (const Floats& sum : {pixels, w1, wp, wi, wpp, wpi, wii, r1, rp, ri, rpp, rpi}) {
      hn::StoreU(sum, kFloats, to);
      to += sums_stride;
    }
  }
}

template <bool kBlur>
HWY_INLINE void MotionsOf(const PixelRows& rows, const SlopeRows& slopes,
                          const LightOfColumns& light, const float* robust_weight, float* weight,
                          std::ptrdiff_t sums_stride, float* sums) {
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  const Floats zero = hn::Zero(kFloats), quarter = hn::Set(kFloats, 0.25F);
  for (int from = 0; from < rows.count; from += lanes) {
    const int x = HWY_MIN(from, rows.count - lanes);
    const Floats gain = Load(light.gain + x), offset = Load(light.offset + x);
    const Floats inverse = Load(light.inverse + x), believed = Load(robust_weight + x);
    const Floats column = hn::Iota(kFloats, static_cast<float>(slopes.first_column + x));
    const auto inner =
        hn::And(hn::Gt(column, zero),
                hn::Lt(column, hn::Set(kFloats, static_cast<float>(slopes.image_columns - 1))));
    Floats w1 = zero, wp1 = zero, wpp = zero, wr1 = zero, wrp = zero, wrr = zero, wx1 = zero,
           wy1 = zero, wpx = zero, wpy = zero, wrx = zero, wry = zero, wxx = zero, wxy = zero,
           wyy = zero, wb1 = zero, wpb = zero, wrb = zero, wxb = zero, wyb = zero, wbb = zero;
    for (int j = 0; j < rows.rows; ++j) {
      const std::ptrdiff_t at = j * rows.stride + x;
      const Floats p = Load(rows.white + at);
      const Floats r = hn::NegMulAdd(gain, p, hn::Sub(Load(rows.value + at), offset));
      const Floats w = hn::Mul(hn::Mul(hn::Max(Load(rows.usable + at), zero), believed),
                               RobustWeight(hn::Mul(r, inverse)));
      hn::StoreU(w, kFloats, weight + at);
      const Floats sx = Load(slopes.white_x + at), sy = Load(slopes.white_y + at);
      const Floats wr = hn::Mul(w, r), wp = hn::Mul(w, p);
      const Floats wx = hn::Mul(w, sx), wy = hn::Mul(w, sy);
      w1 = hn::Add(w1, w);
      wp1 = hn::Add(wp1, wp);
      wpp = hn::MulAdd(wp, p, wpp);
      wr1 = hn::Add(wr1, wr);
      wrp = hn::MulAdd(wr, p, wrp);
      wrr = hn::MulAdd(wr, r, wrr);
      wx1 = hn::Add(wx1, wx);
      wy1 = hn::Add(wy1, wy);
      wpx = hn::MulAdd(wp, sx, wpx);
      wpy = hn::MulAdd(wp, sy, wpy);
      wrx = hn::MulAdd(wr, sx, wrx);
      wry = hn::MulAdd(wr, sy, wry);
      wxx = hn::MulAdd(wx, sx, wxx);
      wxy = hn::MulAdd(wx, sy, wxy);
      wyy = hn::MulAdd(wy, sy, wyy);
      const int row = slopes.first_row + j;
      if (!kBlur || row == 0 || row + 1 >= slopes.image_rows) continue;
      const float *x_at = slopes.white_x + at, *y_at = slopes.white_y + at;
      const Floats across = hn::Sub(Load(x_at + 1), Load(x_at - 1));
      const Floats down = hn::Sub(Load(y_at + rows.stride), Load(y_at - rows.stride));
      const Floats b = hn::IfThenElseZero(inner, hn::Mul(quarter, hn::Add(across, down)));
      const Floats wb = hn::Mul(w, b);
      wb1 = hn::Add(wb1, wb);
      wpb = hn::MulAdd(wb, p, wpb);
      wrb = hn::MulAdd(wb, r, wrb);
      wxb = hn::MulAdd(wb, sx, wxb);
      wyb = hn::MulAdd(wb, sy, wyb);
      wbb = hn::MulAdd(wb, b, wbb);
    }
    float* to = sums + x;
    const auto store = [&](std::initializer_list<Floats> all) {
      for (const Floats& sum : all) {
        hn::StoreU(sum, kFloats, to);
        to += sums_stride;
      }
    };
    store({w1, wp1, wpp, wr1, wrp, wrr, wx1, wy1, wpx, wpy, wrx, wry, wxx, wxy, wyy});
    if (kBlur) store({wb1, wpb, wrb, wxb, wyb, wbb});
  }
}

void Motions(const PixelRows& rows, const SlopeRows& slopes, const LightOfColumns& light,
             const float* robust_weight, float* weight, std::ptrdiff_t sums_stride, float* sums) {
  if (rows.count < static_cast<int>(hn::Lanes(kFloats))) {
    ScalarTileKernels().motions(rows, slopes, light, robust_weight, weight, sums_stride, sums);
  } else if (slopes.blur) {
    MotionsOf<true>(rows, slopes, light, robust_weight, weight, sums_stride, sums);
  } else {
    MotionsOf<false>(rows, slopes, light, robust_weight, weight, sums_stride, sums);
  }
}

void Reduce(const float* sums, std::ptrdiff_t sums_stride, int count, int tile, int tiles,
            float* tile_sums, std::ptrdiff_t tile_stride) {
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  for (int q = 0; q < count; ++q, sums += sums_stride, tile_sums += tile_stride) {
    for (int t = 0; t < tiles; t += lanes) {
      Floats a, b, c, d;
      if (tile == 2) {
        hn::LoadInterleaved2(kFloats, sums + t * 2, a, b);
        hn::StoreU(hn::Add(a, b), kFloats, tile_sums + t);
      } else {
        hn::LoadInterleaved4(kFloats, sums + t * 4, a, b, c, d);
        hn::StoreU(hn::Add(hn::Add(hn::Add(a, b), c), d), kFloats, tile_sums + t);
      }
    }
  }
}

void Products(const Tiles& tiles, FitProducts* products, BlockMotions* blocks) {
  const int lanes = static_cast<int>(hn::Lanes(kFloats));
  const Floats zero = hn::Zero(kFloats);
  Floats jj[kFitProducts], jr[kFitParameters];
  for (Floats& sum : jj) sum = zero;
  for (Floats& sum : jr) sum = zero;
  constexpr int kOfBlock = 6 + 2 * kFitParameters;
  HWY_ALIGN float of_block[kOfBlock][16];
  for (int t = 0; t < tiles.count; t += lanes) {
    const auto useful =
        hn::And(hn::Gt(Load(tiles.gain + t), zero),
                hn::FirstN(kFloats, static_cast<std::size_t>(HWY_MIN(lanes, tiles.count - t))));
    if (hn::AllFalse(kFloats, useful)) continue;
    // Unused elements may have any value, also NaN.
    const auto load = [&](const float* from) { return hn::IfThenElseZero(useful, Load(from + t)); };
    const auto sum = [&](int q) { return load(tiles.sums + q * tiles.stride); };
    const Floats u = load(tiles.u), v = load(tiles.v), gain = load(tiles.gain);
    const Floats u_x = load(tiles.u_x), u_y = load(tiles.u_y);
    const Floats v_x = load(tiles.v_x), v_y = load(tiles.v_y);
    const auto by_u = [&](Floats x, Floats y) { return hn::MulAdd(u_x, x, hn::Mul(u_y, y)); };
    const auto by_v = [&](Floats x, Floats y) { return hn::MulAdd(v_x, x, hn::Mul(v_y, y)); };
    const auto along = [&](Floats x, Floats y, Floats b, Floats out[kFitParameters]) {
      const Floats pu = hn::Neg(by_u(x, y)), pv = hn::Neg(by_v(x, y));
      out[0] = pu;
      out[1] = hn::Mul(pu, u);
      out[2] = hn::Mul(pu, v);
      out[3] = pv;
      out[4] = hn::Mul(pv, u);
      out[5] = hn::Mul(pv, v);
      const Floats both = hn::Neg(hn::Add(out[1], out[5]));
      out[6] = hn::Mul(both, u);
      out[7] = hn::Mul(both, v);
      out[8] = b;
    };
    Floats j[kFitParameters];
    for (int q = 0; q < 6; ++q) hn::Store(sum(q), kFloats, of_block[q]);
    along(sum(6), sum(7), sum(15), j);
    for (int a = 0; a < kFitParameters; ++a) hn::Store(j[a], kFloats, of_block[6 + a]);
    along(sum(8), sum(9), sum(16), j);
    for (int a = 0; a < kFitParameters; ++a) {
      hn::Store(j[a], kFloats, of_block[6 + kFitParameters + a]);
    }
    along(sum(10), sum(11), sum(17), j);
    for (int a = 0; a < kFitParameters; ++a) jr[a] = hn::MulAdd(gain, j[a], jr[a]);

    const Floats gain2 = hn::Mul(gain, gain);
    const Floats xx = hn::Mul(gain2, sum(12)), xy = hn::Mul(gain2, sum(13));
    const Floats yy = hn::Mul(gain2, sum(14));
    const Floats ux = by_u(xx, xy), uy = by_u(xy, yy), vx = by_v(xx, xy), vy = by_v(xy, yy);
    const Floats uu = by_u(ux, uy), uv = by_v(ux, uy), vv = by_v(vx, vy);
    const Floats xb = hn::Mul(gain2, sum(18)), yb = hn::Mul(gain2, sum(19));
    const Floats ub = by_u(xb, yb), vb = by_v(xb, yb);
    // One row of the products for each parameter: that of p_u, p_v and b with it, times the other's
    // factors.
    Floats* to = jj;
    const auto add_row = [&](Floats with_u, Floats with_v, Floats with_b, int upto) {
      Floats row[kFitParameters];
      row[0] = hn::Neg(with_u);
      row[1] = hn::Mul(row[0], u);
      row[2] = hn::Mul(row[0], v);
      row[3] = hn::Neg(with_v);
      row[4] = hn::Mul(row[3], u);
      row[5] = hn::Mul(row[3], v);
      const Floats both = hn::Neg(hn::Add(row[1], row[5]));
      row[6] = hn::Mul(both, u);
      row[7] = hn::Mul(both, v);
      row[8] = with_b;
      for (int b = 0; b <= upto; ++b, ++to) *to = hn::Add(*to, row[b]);
    };
    const Floats nuu = hn::Neg(uu), nuv = hn::Neg(uv), nvv = hn::Neg(vv);
    add_row(nuu, nuv, zero, 0);
    add_row(hn::Mul(nuu, u), hn::Mul(nuv, u), zero, 1);
    add_row(hn::Mul(nuu, v), hn::Mul(nuv, v), zero, 2);
    add_row(nuv, nvv, zero, 3);
    add_row(hn::Mul(nuv, u), hn::Mul(nvv, u), zero, 4);
    add_row(hn::Mul(nuv, v), hn::Mul(nvv, v), zero, 5);
    const Floats along_u = hn::MulAdd(uu, u, hn::Mul(uv, v));
    const Floats along_v = hn::MulAdd(uv, u, hn::Mul(vv, v));
    add_row(hn::Mul(along_u, u), hn::Mul(along_v, u), zero, 6);
    add_row(hn::Mul(along_u, v), hn::Mul(along_v, v), zero, 7);
    add_row(ub, vb, hn::Mul(gain2, sum(20)), 8);

    const int last = HWY_MIN(lanes, tiles.count - t);
    for (int lane = 0; lane < last; ++lane) {
      BlockMotions& block = blocks[tiles.block[t + lane]];
      block.w += of_block[0][lane];
      block.p += of_block[1][lane];
      block.pp += of_block[2][lane];
      block.r += of_block[3][lane];
      block.rp += of_block[4][lane];
      block.rr += of_block[5][lane];
      for (int a = 0; a < kFitParameters; ++a) {
        block.j[a] += of_block[6 + a][lane];
        block.pj[a] += of_block[6 + kFitParameters + a][lane];
      }
    }
  }
  const auto total = [](Floats all) {
    return static_cast<double>(hn::GetLane(hn::SumOfLanes(kFloats, all)));
  };
  for (int k = 0; k < kFitProducts; ++k) products->jj[k] += total(jj[k]);
  for (int a = 0; a < kFitParameters; ++a) products->jr[a] += total(jr[a]);
}

}  // namespace HWY_NAMESPACE
}  // namespace pleinair::tracker
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {
HWY_EXPORT(Mark);
HWY_EXPORT(Levels);
HWY_EXPORT(Motions);
HWY_EXPORT(Reduce);
HWY_EXPORT(Products);

const TileKernels& SimdTileKernels() {
  static const TileKernels kKernels{
      [](const MapOfRow& map, const KnownPart& known, const float* inverse_variance, int count,
         float* usable) {
        HWY_DYNAMIC_DISPATCH(Mark)
        (map, known, inverse_variance, count, usable);
      },
      [](const PixelRows& rows, const LightOfColumns& light, std::ptrdiff_t sums_stride,
         float* sums) {
        HWY_DYNAMIC_DISPATCH(Levels)
        (rows, light, sums_stride, sums);
      },
      [](const PixelRows& rows, const SlopeRows& slopes, const LightOfColumns& light,
         const float* robust_weight, float* weight, std::ptrdiff_t sums_stride, float* sums) {
        HWY_DYNAMIC_DISPATCH(Motions)
        (rows, slopes, light, robust_weight, weight, sums_stride, sums);
      },
      [](const float* sums, std::ptrdiff_t sums_stride, int count, int tile, int tiles,
         float* tile_sums, std::ptrdiff_t tile_stride) {
        HWY_DYNAMIC_DISPATCH(Reduce)
        (sums, sums_stride, count, tile, tiles, tile_sums, tile_stride);
      },
      [](const Tiles& tiles, FitProducts* products, BlockMotions* blocks) {
        HWY_DYNAMIC_DISPATCH(Products)(tiles, products, blocks);
      }};
  return kKernels;
}

}  // namespace pleinair::tracker
#endif  // HWY_ONCE
