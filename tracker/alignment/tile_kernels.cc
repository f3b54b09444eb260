#include "tracker/alignment/tile_kernels.h"

#include <algorithm>
#include <cmath>

namespace pleinair::tracker {
namespace {

void Mark(const MapOfRow& map, const KnownPart& known, const float* inverse_variance, int count,
          float* usable) {
  for (int x = 0; x < count; ++x) {
    const float c = map.column[x], r = map.row[x];
    const float rc =
        std::min(known.max_reach_modules,
                 known.reach_px * (std::fabs(map.column_x[x]) + std::fabs(map.column_y[x])));
    const float rr = std::min(known.max_reach_modules,
                              known.reach_px * (std::fabs(map.row_x[x]) + std::fabs(map.row_y[x])));
    const bool on_marker = c > rc && c < known.modules - rc && r > rr && r < known.modules - rr;
    const bool is_unknown = std::fabs(c - known.unknown_middle) < known.unknown_half + 0.8F * rc &&
                            std::fabs(r - known.unknown_middle) < known.unknown_half + 0.8F * rr;
    usable[x] = on_marker && !is_unknown ? inverse_variance[x] : -1.0F;
  }
}

/// Geman–McClure weight of a residual `z`, relative to the robust share.
float RobustWeight(float z) {
  const float kept = 1.0F / (1.0F + z * z);
  return kept * kept;
}

void Levels(const PixelRows& rows, const LightOfColumns& light, std::ptrdiff_t sums_stride,
            float* sums) {
  for (int x = 0; x < rows.count; ++x) {
    std::array<float, kLevelSums> sum{};
    for (int y = 0; y < rows.rows; ++y) {
      const std::ptrdiff_t at = y * rows.stride + x;
      if (rows.usable[at] < 0.0F) continue;
      const float w = rows.usable[at], p = rows.white[at], i = rows.value[at];
      const float r =
          w * RobustWeight((i - light.offset[x] - light.gain[x] * p) * light.inverse[x]);
      const std::array<float, kLevelSums> add{1.0F,      w, w * p, w * i, w * p * p, w * p * i,
                                              w * i * i, r, r * p, r * i, r * p * p, r * p * i};
      for (int q = 0; q < kLevelSums; ++q) sum[q] += add[q];
    }
    for (int q = 0; q < kLevelSums; ++q) sums[q * sums_stride + x] = sum[q];
  }
}

void Motions(const PixelRows& rows, const SlopeRows& slopes, const LightOfColumns& light,
             const float* robust_weight, float* weight, std::ptrdiff_t sums_stride, float* sums) {
  const int used = slopes.blur ? kMotionSums : kSlopeSums;
  for (int x = 0; x < rows.count; ++x) {
    std::array<float, kMotionSums> sum{};
    const int column = slopes.first_column + x;
    for (int j = 0; j < rows.rows; ++j) {
      const std::ptrdiff_t at = j * rows.stride + x;
      const float p = rows.white[at];
      const float r = rows.value[at] - light.offset[x] - light.gain[x] * p;
      const float w =
          std::max(rows.usable[at], 0.0F) * robust_weight[x] * RobustWeight(r * light.inverse[x]);
      weight[at] = w;
      const float sx = slopes.white_x[at], sy = slopes.white_y[at];
      float b = 0.0F;
      const int row = slopes.first_row + j;
      if (slopes.blur && row > 0 && row + 1 < slopes.image_rows && column > 0 &&
          column + 1 < slopes.image_columns) {
        // The heat equation: a Gaussian's variance grows linearly with time.
        b = 0.25F * (slopes.white_x[at + 1] - slopes.white_x[at - 1] +
                     slopes.white_y[at + rows.stride] - slopes.white_y[at - rows.stride]);
      }
      const float wr = w * r, wp = w * p, wx = w * sx, wy = w * sy, wb = w * b;
      const std::array<float, kMotionSums> add{w,       wp,      wp * p,  wr,      wr * p,  wr * r,
                                               wx,      wy,      wp * sx, wp * sy, wr * sx, wr * sy,
                                               wx * sx, wx * sy, wy * sy, wb,      wp * b,  wr * b,
                                               wx * b,  wy * b,  wb * b};
      for (int q = 0; q < used; ++q) sum[q] += add[q];
    }
    for (int q = 0; q < used; ++q) sums[q * sums_stride + x] = sum[q];
  }
}

void Reduce(const float* sums, std::ptrdiff_t sums_stride, int count, int tile, int tiles,
            float* tile_sums, std::ptrdiff_t tile_stride) {
  for (int q = 0; q < count; ++q) {
    for (int t = 0; t < tiles; ++t) {
      const float* columns = sums + q * sums_stride + t * tile;
      float sum = 0.0F;
      for (int x = 0; x < tile; ++x) sum += columns[x];
      tile_sums[q * tile_stride + t] = sum;
    }
  }
}

/// A sum with p_u and p_v in place of p_x and p_y, times the factors of each parameter. The motion
/// moves the observation at (u, v) by (m0 + m1 u + m2 v - (m6 u + m7 v) u, m3 + … v).
std::array<double, kFitParameters> AlongMotions(double pu, double pv, double b, double u,
                                                double v) {
  const double along = pu * u + pv * v;
  return {-pu, -pu * u, -pu * v, -pv, -pv * u, -pv * v, along * u, along * v, b};
}

void Products(const Tiles& tiles, FitProducts* products, BlockMotions* blocks) {
  for (int t = 0; t < tiles.count; ++t) {
    const double gain = tiles.gain[t];
    if (!(gain > 0.0)) continue;
    const auto sum = [&](int q) { return static_cast<double>(tiles.sums[q * tiles.stride + t]); };
    const double u = tiles.u[t], v = tiles.v[t];
    const auto by_u = [&](double x, double y) { return tiles.u_x[t] * x + tiles.u_y[t] * y; };
    const auto by_v = [&](double x, double y) { return tiles.v_x[t] * x + tiles.v_y[t] * y; };
    const auto j = AlongMotions(by_u(sum(6), sum(7)), by_v(sum(6), sum(7)), sum(15), u, v);
    const auto pj = AlongMotions(by_u(sum(8), sum(9)), by_v(sum(8), sum(9)), sum(16), u, v);
    const auto rj = AlongMotions(by_u(sum(10), sum(11)), by_v(sum(10), sum(11)), sum(17), u, v);
    const double uu = by_u(by_u(sum(12), sum(13)), by_u(sum(13), sum(14)));
    const double uv = by_v(by_u(sum(12), sum(13)), by_u(sum(13), sum(14)));
    const double vv = by_v(by_v(sum(12), sum(13)), by_v(sum(13), sum(14)));
    const double ub = by_u(sum(18), sum(19)), vb = by_v(sum(18), sum(19)), bb = sum(20);
    BlockMotions& block = blocks[tiles.block[t]];
    block.w += sum(0);
    block.p += sum(1);
    block.pp += sum(2);
    block.r += sum(3);
    block.rp += sum(4);
    block.rr += sum(5);
    // J = f p_u + g p_v + h b.
    const std::array<double, kFitParameters> f{-1, -u, -v, 0, 0, 0, u * u, u * v, 0};
    const std::array<double, kFitParameters> g{0, 0, 0, -1, -u, -v, u * v, v * v, 0};
    int at = 0;
    for (int a = 0; a < kFitParameters; ++a) {
      block.j[a] += j[a];
      block.pj[a] += pj[a];
      products->jr[a] += gain * rj[a];
      const double ha = a == kFitParameters - 1;
      for (int b = 0; b <= a; ++b) {
        const double hb = b == kFitParameters - 1;
        products->jj[at++] +=
            gain * gain *
            (f[a] * f[b] * uu + (f[a] * g[b] + g[a] * f[b]) * uv + g[a] * g[b] * vv +
             (f[a] * hb + ha * f[b]) * ub + (g[a] * hb + ha * g[b]) * vb + ha * hb * bb);
      }
    }
  }
}

}  // namespace

const TileKernels& ScalarTileKernels() {
  static const TileKernels kKernels{&Mark, &Levels, &Motions, &Reduce, &Products};
  return kKernels;
}

}  // namespace pleinair::tracker
