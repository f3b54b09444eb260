#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <array>
#include <cstddef>

namespace pleinair::tracker {

/// Rows that kernels write must be writable, and rows of tiles readable, this far beyond their
/// ends.
inline constexpr int kTileSlack = 64;

/// Defines which pixels belong to the known part of a marker.
struct KnownPart {
  float modules;            ///< Along the marker.
  float reach_px;           ///< What lies farther out must not be blurred into the pixel.
  float max_reach_modules;  ///< Upper limit of that reach: too little of small markers would be
                            ///< left otherwise.
  float unknown_middle;     ///< Centre of a square of unknown modules in the marker
  float unknown_half;       ///< … and half its side; negative: all modules are known.
};

/// Map of a row of pixels to the marker; see PlaneMap.
struct MapOfRow {
  const float *column, *row, *column_x, *column_y, *row_x, *row_y;
};

/// The rows of pixels, `stride` apart, that one row of tiles covers.
struct PixelRows {
  std::ptrdiff_t stride;
  int rows, count;
  const float *white, *value;
  const float* usable;  ///< Inverse variance; negative: not on the known part of the marker.
};

/// Light on each column of a row of tiles.
struct LightOfColumns {
  const float *gain, *offset;
  const float* inverse;  ///< 1 / (gain × robust share); 0 where the light is unknown.
};

/// Sums over pixels, with p the share of white and i the observed value. First their number. With
/// the inverse variance w: w, w p, w i, w p², w p i, w i². With the robust weight r: r, r p, r i, r
/// p², r p i.
inline constexpr int kLevelSums = 12;

/// Sums over pixels with the final weight w, residual r, slopes x and y of p, and its derivative b
/// by the blur's variance. Order: w, wp, wp², wr, wrp, wr², wx, wy, wpx, wpy, wrx, wry, wx², wxy,
/// wy². If the blur is fitted, also wb, wpb, wrb, wxb, wyb, wb².
inline constexpr int kSlopeSums = 15, kBlurSums = 6, kMotionSums = kSlopeSums + kBlurSums;

struct SlopeRows {
  const float *white_x, *white_y;
  bool blur;
  int first_row, image_rows;  ///< At the image's edges the derivative by the blur is 0.
  int first_column, image_columns;
};

/// Eight motion parameters and the variance of the blur.
inline constexpr int kFitParameters = 9;
inline constexpr int kFitProducts = kFitParameters * (kFitParameters + 1) / 2;

/// Tiles in parallel arrays: sums[q * stride + tile].
struct Tiles {
  int count;
  std::ptrdiff_t stride;
  const float* sums;                   ///< kMotionSums.
  const float *u, *v;                  ///< Centre in half edges.
  const float *u_x, *u_y, *v_x, *v_y;  ///< ∂p/∂u = u_x p_x + u_y p_y; v likewise.
  const float* gain;                   ///< 0: not used.
  const unsigned char* block;
};

/// Sums of one block; J: derivatives of p by the parameters.
struct BlockMotions {
  /// As the first of kMotionSums.
  double w, p, pp, r, rp, rr;
  std::array<double, kFitParameters> j, pj;
};

struct FitProducts {
  std::array<double, kFitProducts> jj{};    ///< Σ gain² w J Jᵀ, lower triangle by rows,
  std::array<double, kFitParameters> jr{};  ///< … and Σ gain w r J.
};

/// Operations of BlockSums on rows of pixels and tiles. The SIMD version and its scalar reference
/// agree to single precision. Sums over pixels are per column: sums[q * sums_stride + x].
struct TileKernels {
  void (*mark)(const MapOfRow& map, const KnownPart& known, const float* inverse_variance,
               int count, float* usable);
  void (*levels)(const PixelRows& rows, const LightOfColumns& light, std::ptrdiff_t sums_stride,
                 float* sums);
  /// `robust_weight` is the block weight of each column; `weight` receives each pixel's final
  /// weight.
  void (*motions)(const PixelRows& rows, const SlopeRows& slopes, const LightOfColumns& light,
                  const float* robust_weight, float* weight, std::ptrdiff_t sums_stride,
                  float* sums);
  /// Adds `tile` (2 or 4) columns of each of `count` sums.
  void (*reduce)(const float* sums, std::ptrdiff_t sums_stride, int count, int tile, int tiles,
                 float* tile_sums, std::ptrdiff_t tile_stride);
  void (*products)(const Tiles& tiles, FitProducts* products, BlockMotions* blocks);
};
const TileKernels& ScalarTileKernels();
const TileKernels& SimdTileKernels();

}  // namespace pleinair::tracker
