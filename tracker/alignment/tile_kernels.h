#pragma once

// Internal: between the .cc files of this module; not installed.

#include <array>
#include <cstddef>

namespace pleinair::tracker {

/// Rows that kernels make may be written, and those of tiles read, so far beyond their ends.
inline constexpr int kTileSlack = 64;

/// Which pixels belong to what is known of a marker.
struct KnownPart {
  float modules;            ///< Along the marker.
  float reach_px;           ///< What lies beyond must not be blurred into the pixel.
  float max_reach_modules;  ///< Of small prints too little would be left otherwise.
  float unknown_middle;     ///< A square in the marker that is not known, its middle
  float unknown_half;       ///< … and half its side; negative: all is known.
};

/// Map of a row of pixels onto the marker; see PlaneMap.
struct MapOfRow {
  const float *column, *row, *column_x, *column_y, *row_x, *row_y;
};

/// Some rows of pixels, `stride` apart, that one row of tiles covers.
struct PixelRows {
  std::ptrdiff_t stride;
  int rows, count;
  const float *white, *value;
  const float* usable;  ///< Certainty; negative: not of what is known of the marker.
};

/// The light on each column of a row of tiles.
struct LightOfColumns {
  const float *gain, *offset;
  const float* inverse;  ///< 1 / (gain × robust share); 0 where the light is unknown.
};

/// Sums of pixels: how many, then with the inverse variance w: w, w p, w i, w p², w p i, w i² (p:
/// share of white, i: what is observed), then with the robust weight r: r, r p, r i, r p², r p i.
inline constexpr int kLevelSums = 12;

/// Sums of pixels with the final weight w, r = what is left over, x and y the slopes of p, b its
/// derivative by the blur's variance: w, wp, wp², wr, wrp, wr², wx, wy, wpx, wpy, wrx, wry, wx²,
/// wxy, wy², and, if the blur is fitted, wb, wpb, wrb, wxb, wyb, wb².
inline constexpr int kSlopeSums = 15, kBlurSums = 6, kMotionSums = kSlopeSums + kBlurSums;

struct SlopeRows {
  const float *white_x, *white_y;
  bool blur;
  int first_row, image_rows;  ///< At the image's edges the blur's derivative is 0.
  int first_column, image_columns;
};

/// Eight motions of the marker and the variance of the blur.
inline constexpr int kFitParameters = 9;
inline constexpr int kFitProducts = kFitParameters * (kFitParameters + 1) / 2;

/// Tiles in parallel arrays: sums[q * stride + tile].
struct Tiles {
  int count;
  std::ptrdiff_t stride;
  const float* sums;                   ///< kMotionSums.
  const float *u, *v;                  ///< Its middle in half edges.
  const float *u_x, *u_y, *v_x, *v_y;  ///< Derivative of p by u is u_x p_x + u_y p_y, by v alike.
  const float* gain;                   ///< 0: of no use.
  const unsigned char* block;
};

/// With J the derivatives of p by the parameters.
struct BlockMotions {
  /// As the first of kMotionSums.
  double w, p, pp, r, rp, rr;
  std::array<double, kFitParameters> j, pj;
};

struct FitProducts {
  std::array<double, kFitProducts> jj{};    ///< Σ gain² w J Jᵀ, lower triangle by rows,
  std::array<double, kFitParameters> jr{};  ///< … and Σ gain w r J.
};

/// What BlockSums does to rows of pixels and tiles; the SIMD version and its scalar reference agree
/// to single precision. Sums of pixels are by column: sums[q * sums_stride + x].
struct TileKernels {
  void (*mark)(const MapOfRow& map, const KnownPart& known, const float* inverse_variance,
               int count, float* usable);
  void (*levels)(const PixelRows& rows, const LightOfColumns& light, std::ptrdiff_t sums_stride,
                 float* sums);
  /// `belief` is each column's block's weight; `weight` becomes that of each pixel.
  void (*motions)(const PixelRows& rows, const SlopeRows& slopes, const LightOfColumns& light,
                  const float* robust_weight, float* weight, std::ptrdiff_t sums_stride,
                  float* sums);
  /// Adds up `tile` (2 or 4) columns each of `count` sums.
  void (*reduce)(const float* sums, std::ptrdiff_t sums_stride, int count, int tile, int tiles,
                 float* tile_sums, std::ptrdiff_t tile_stride);
  void (*products)(const Tiles& tiles, FitProducts* products, BlockMotions* blocks);
};
const TileKernels& ScalarTileKernels();
const TileKernels& SimdTileKernels();

}  // namespace pleinair::tracker
