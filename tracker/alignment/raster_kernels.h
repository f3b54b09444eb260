#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstddef>
#include <cstdint>

#include "tracker/alignment/marker_raster.h"

namespace pleinair::tracker {

/// Rows of floats must be readable and writable this far beyond their ends.
inline constexpr int kRowSlack = 16;

/// Positions on the marker of a row of pixels; see PlaneMap.
struct MapRow {
  float *column, *row, *column_x, *column_y, *row_x, *row_y;
};

/// Rays of a row of pixels, relative to an origin near them, so that single precision suffices.
struct RayRow {
  const float *x, *y;
  std::ptrdiff_t stride;  ///< To the rays of the rows above and below.
  float origin_x, origin_y;
};

/// The modules around each node (corner of modules) of a marker. Bit 4 j + i is the module i - 2
/// columns and j - 2 rows from the node.
struct NodeTable {
  const std::uint32_t* around;
  int nodes;  ///< Along each side.
};

/// Filter taps for `per_pixel` samples per pixel over `pixels` pixels, and those of the derivative.
struct BlurTaps {
  const float *weight, *slope;
  int per_pixel, pixels;
};

/// Pixels of a row near a marker, and the wider range that contributes to them.
struct RowRanges {
  RowRange near, far;
};

/// Row operations of MarkerRaster. The SIMD version and its scalar reference agree to single
/// precision.
struct RasterKernels {
  void (*map)(const RayRow& rays, const float homography[9], int count, const MapRow& out);
  /// The shortest ranges that contain the pixels closer than `near_px` and `far_px` to a marker of
  /// `modules`.
  RowRanges (*ranges)(const MapRow& map, float modules, float near_px, float far_px, int count);
  /// Samples each pixel `per_pixel`² times: out[j][i][x], j from the top, rows `stride` apart.
  void (*sample)(const MapRow& map, const NodeTable& table, int per_pixel, int count,
                 std::ptrdiff_t stride, float* out);
  /// Blurs one row of samples in[i][x]; `blurred[x]` is the result at the pixel in the centre of
  /// the taps.
  void (*along_row)(const float* in, std::ptrdiff_t stride, const BlurTaps& taps, int count,
                    float* blurred, float* blurred_x);
  /// Blurs along columns: rows[k] belongs to tap k. The results have no slack.
  void (*along_column)(const float* const* rows, const float* const* rows_x, const BlurTaps& taps,
                       int count, float* white, float* white_x, float* white_y);
};
const RasterKernels& ScalarRasterKernels();
const RasterKernels& SimdRasterKernels();

/// Limits of a pixel: samples along its side, and modules along either axis. Within them all
/// samples lie next to the node nearest to the pixel's centre.
inline constexpr int kMaxSamplesNearCentre = 2;
inline constexpr float kMaxSlopeNearCentre = 1.98F;
inline constexpr float kMinBox2_modules2 = 1e-6F;
inline constexpr float kMaxModule = 1e6F;

}  // namespace pleinair::tracker
