#include "tracker/quads/dark_mask.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tracker/quads/dark_mask_simd.cc"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

// The same arithmetic as the scalar reference in dark_mask.cc, in whole vectors; the reference
// processes the rest of a row.
HWY_BEFORE_NAMESPACE();
namespace pleinair::tracker {
namespace HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR  // No vectors: use the reference.

void TileExtremes(const std::uint8_t* pixels, std::ptrdiff_t stride, int width,
                  std::uint8_t* tile_min, std::uint8_t* tile_max) {
  ScalarDarkMaskKernels().tile_extremes(pixels, stride, width, tile_min, tile_max);
}

void Thresholds(const std::uint8_t* const min_rows[3], const std::uint8_t* const max_rows[3],
                int width, DarkContrast contrast, std::uint8_t* column_min,
                std::uint8_t* column_max, std::uint8_t* thresholds) {
  ScalarDarkMaskKernels().thresholds(min_rows, max_rows, width, contrast, column_min, column_max,
                                     thresholds);
}

void Compare(const std::uint8_t* pixels, const std::uint8_t* thresholds, int width,
             std::uint8_t* bits) {
  ScalarDarkMaskKernels().compare(pixels, thresholds, width, bits);
}

void Halve(const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* means) {
  ScalarDarkMaskKernels().halve(upper, lower, width, means);
}

#else

namespace hn = hwy::HWY_NAMESPACE;

const hn::ScalableTag<std::uint8_t> kBytes;

/// Each byte becomes the result over the four bytes of its tile.
template <class Vector, class Combine>
Vector OverTile(Vector v, Combine combine) {
  const hn::RepartitionToWide<hn::RepartitionToWide<decltype(kBytes)> > quads;
  v = combine(v, hn::BitCast(kBytes, hn::RotateRight<8>(hn::BitCast(quads, v))));
  return combine(v, hn::BitCast(kBytes, hn::RotateRight<16>(hn::BitCast(quads, v))));
}

void TileExtremes(const std::uint8_t* pixels, std::ptrdiff_t stride, int width,
                  std::uint8_t* tile_min, std::uint8_t* tile_max) {
  const int lanes = static_cast<int>(hn::Lanes(kBytes));
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    const auto r0 = hn::LoadU(kBytes, pixels + x), r1 = hn::LoadU(kBytes, pixels + stride + x);
    const auto r2 = hn::LoadU(kBytes, pixels + 2 * stride + x);
    const auto r3 = hn::LoadU(kBytes, pixels + 3 * stride + x);
    const auto least = hn::Min(hn::Min(r0, r1), hn::Min(r2, r3));
    const auto greatest = hn::Max(hn::Max(r0, r1), hn::Max(r2, r3));
    hn::StoreU(OverTile(least, [](auto a, auto b) { return hn::Min(a, b); }), kBytes, tile_min + x);
    hn::StoreU(OverTile(greatest, [](auto a, auto b) { return hn::Max(a, b); }), kBytes,
               tile_max + x);
  }
  ScalarDarkMaskKernels().tile_extremes(pixels + x, stride, width - x, tile_min + x, tile_max + x);
}

void Thresholds(const std::uint8_t* const min_rows[3], const std::uint8_t* const max_rows[3],
                int width, DarkContrast contrast, std::uint8_t* column_min,
                std::uint8_t* column_max, std::uint8_t* thresholds) {
  const int lanes = static_cast<int>(hn::Lanes(kBytes));
  // First over the three rows, padding included, then over three tiles of the row.
  const int padded = width + 2 * kTile;
  int x = 0;
  for (; x + lanes <= padded; x += lanes) {
    const int at = x - kTile;
    const auto least =
        hn::Min(hn::LoadU(kBytes, min_rows[0] + at),
                hn::Min(hn::LoadU(kBytes, min_rows[1] + at), hn::LoadU(kBytes, min_rows[2] + at)));
    const auto greatest =
        hn::Max(hn::LoadU(kBytes, max_rows[0] + at),
                hn::Max(hn::LoadU(kBytes, max_rows[1] + at), hn::LoadU(kBytes, max_rows[2] + at)));
    hn::StoreU(least, kBytes, column_min + x);
    hn::StoreU(greatest, kBytes, column_max + x);
  }
  for (; x < padded; ++x) {
    const int at = x - kTile;
    column_min[x] = HWY_MIN(min_rows[0][at], HWY_MIN(min_rows[1][at], min_rows[2][at]));
    column_max[x] = HWY_MAX(max_rows[0][at], HWY_MAX(max_rows[1][at], max_rows[2][at]));
  }
  const auto enough = hn::Set(kBytes, static_cast<std::uint8_t>(contrast.codes));
  const auto zero = hn::Zero(kBytes);
  for (x = 0; x + lanes <= width; x += lanes) {
    const auto least = hn::Min(hn::LoadU(kBytes, column_min + x),
                               hn::Min(hn::LoadU(kBytes, column_min + x + kTile),
                                       hn::LoadU(kBytes, column_min + x + 2 * kTile)));
    const auto greatest = hn::Max(hn::LoadU(kBytes, column_max + x),
                                  hn::Max(hn::LoadU(kBytes, column_max + x + kTile),
                                          hn::LoadU(kBytes, column_max + x + 2 * kTile)));
    const auto range = hn::Sub(greatest, least);
    auto share = greatest;
    for (int i = 0; i < contrast.halvings; ++i) share = hn::AverageRound(share, zero);
    const auto observed = hn::Eq(hn::Max(range, hn::Max(share, enough)), range);
    auto threshold = least;
    for (int digit = 1; digit < 8; digit *= 2) {
      threshold = hn::AverageRound(threshold, (contrast.eighths & digit) != 0 ? greatest : least);
    }
    hn::StoreU(hn::IfThenElseZero(observed, threshold), kBytes, thresholds + x);
  }
  const std::uint8_t *min_rest[3], *max_rest[3];
  for (int j = 0; j < 3; ++j) {
    min_rest[j] = min_rows[j] + x;
    max_rest[j] = max_rows[j] + x;
  }
  ScalarDarkMaskKernels().thresholds(min_rest, max_rest, width - x, contrast, column_min,
                                     column_max, thresholds + x);
}

void Compare(const std::uint8_t* pixels, const std::uint8_t* thresholds, int width,
             std::uint8_t* bits) {
  const int lanes = static_cast<int>(hn::Lanes(kBytes));
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    const auto dark = hn::Lt(hn::LoadU(kBytes, pixels + x), hn::LoadU(kBytes, thresholds + x));
    hn::StoreMaskBits(kBytes, dark, bits + x / 8);
  }
  ScalarDarkMaskKernels().compare(pixels + x, thresholds + x, width - x, bits + x / 8);
}

void Halve(const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* means) {
  const int lanes = static_cast<int>(hn::Lanes(kBytes));
  const hn::RepartitionToWide<decltype(kBytes)> wide;
  const hn::Rebind<std::uint8_t, decltype(wide)> half_bytes;
  const int half = lanes / 2;
  const auto low = hn::Set(wide, 0xFF);
  const auto two = hn::Set(wide, 2);
  int x = 0;
  for (; x + half <= width; x += half) {
    const auto a = hn::BitCast(wide, hn::LoadU(kBytes, upper + 2 * x));
    const auto b = hn::BitCast(wide, hn::LoadU(kBytes, lower + 2 * x));
    const auto sum = hn::Add(hn::Add(hn::And(a, low), hn::ShiftRight<8>(a)),
                             hn::Add(hn::And(b, low), hn::ShiftRight<8>(b)));
    const auto mean = hn::ShiftRight<2>(hn::Add(sum, two));
    hn::StoreU(hn::TruncateTo(half_bytes, mean), half_bytes, means + x);
  }
  ScalarDarkMaskKernels().halve(upper + 2 * x, lower + 2 * x, width - x, means + x);
}

#endif  // HWY_TARGET == HWY_SCALAR

}  // namespace HWY_NAMESPACE
}  // namespace pleinair::tracker
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pleinair::tracker {
HWY_EXPORT(TileExtremes);
HWY_EXPORT(Thresholds);
HWY_EXPORT(Compare);
HWY_EXPORT(Halve);

const DarkMaskKernels& SimdDarkMaskKernels() {
  static const DarkMaskKernels kKernels{
      [](const std::uint8_t* pixels, std::ptrdiff_t stride, int width, std::uint8_t* tile_min,
         std::uint8_t* tile_max) {
        HWY_DYNAMIC_DISPATCH(TileExtremes)(pixels, stride, width, tile_min, tile_max);
      },
      [](const std::uint8_t* const min_rows[3], const std::uint8_t* const max_rows[3], int width,
         DarkContrast contrast, std::uint8_t* column_min, std::uint8_t* column_max,
         std::uint8_t* thresholds) {
        HWY_DYNAMIC_DISPATCH(Thresholds)
        (min_rows, max_rows, width, contrast, column_min, column_max, thresholds);
      },
      [](const std::uint8_t* pixels, const std::uint8_t* thresholds, int width,
         std::uint8_t* bits) {
        HWY_DYNAMIC_DISPATCH(Compare)
        (pixels, thresholds, width, bits);
      },
      [](const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* means) {
        HWY_DYNAMIC_DISPATCH(Halve)(upper, lower, width, means);
      }};
  return kKernels;
}

}  // namespace pleinair::tracker
#endif  // HWY_ONCE
