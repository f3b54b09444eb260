#pragma once

// Internal: shared by the .cc files of this module; not installed.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/image.h"

namespace pleinair::tracker {

/// One bit per pixel, 64 pixels per word, the lowest bit leftmost; a set bit is a dark pixel.
struct BitMask {
  int width = 0, height = 0, words_per_row = 0;
  std::vector<std::uint64_t> words;

  const std::uint64_t* row(int y) const {
    return words.data() + static_cast<std::ptrdiff_t>(y) * words_per_row;
  }
  bool operator()(int x, int y) const { return (row(y)[x >> 6] >> (x & 63) & 1) != 0; }
};

/// Buffers of ComputeDarkMask(), reused between images. Rows of tiles hold each tile's value once
/// for each of its columns.
struct DarkMaskBuffers {
  std::vector<std::uint8_t> tile_min, tile_max;
  std::vector<std::uint8_t> threshold;
  std::vector<std::uint8_t> column_min, column_max;
};

inline constexpr int kTile = 4;  ///< Edge of a tile in pixels.

/// Minimum contrast of a neighbourhood, and the threshold between its minimum and maximum.
struct DarkContrast {
  int codes = 0;     ///< Minimum difference of maximum and minimum, in 8-bit values.
  int halvings = 2;  ///< The difference must also be at least the maximum shifted right by this.
  int eighths = 4;   ///< The threshold is this many eighths of the way from minimum to maximum.
};

/// Operations on one row of tiles; the SIMD version and its scalar reference agree bit for bit.
struct DarkMaskKernels {
  /// Minimum and maximum of each tile over four rows of `width` pixels (a multiple of kTile),
  /// written once for each column of the tile.
  void (*tile_extremes)(const std::uint8_t* pixels, std::ptrdiff_t stride, int width,
                        std::uint8_t* tile_min, std::uint8_t* tile_max);
  /// Thresholds of one row of tiles from the extremes of 3×3 tiles if these differ by `contrast`,
  /// else 0. The three rows have a tile's width of padding on both sides. `column_*` is scratch
  /// memory of the same length.
  void (*thresholds)(const std::uint8_t* const min_rows[3], const std::uint8_t* const max_rows[3],
                     int width, DarkContrast contrast, std::uint8_t* column_min,
                     std::uint8_t* column_max, std::uint8_t* thresholds);
  /// Bits of the pixels below their thresholds; `bits` has room for whole words.
  void (*compare)(const std::uint8_t* pixels, const std::uint8_t* thresholds, int width,
                  std::uint8_t* bits);
  /// Rounded means of 2×2 pixels of two rows: `width` results.
  void (*halve)(const std::uint8_t* upper, const std::uint8_t* lower, int width,
                std::uint8_t* means);
};

const DarkMaskKernels& ScalarDarkMaskKernels();
/// The fastest implementation for this machine (Highway).
const DarkMaskKernels& SimdDarkMaskKernels();

/// Adaptive threshold as in AprilTag 3 (Wang & Olson, "AprilTag 2: Efficient and robust fiducial
/// detection", IROS 2016, section III-A). Marks pixels darker than a threshold between the extremes
/// of 4×4 tiles, taken over 3×3 tiles. Tiles in neighbourhoods of low contrast have no dark pixels.
/// Deviations: the threshold need not be half way. The minimum contrast depends on the noise of
/// this image (up to `most.codes`) and on the neighbourhood's brightness. Thus dark exposures work
/// and noise makes no speckle. The last columns and rows that do not fill a tile (up to three) are
/// never dark.
void ComputeDarkMask(ImageView<const std::uint8_t> grey, DarkContrast most,
                     const DarkMaskKernels& kernels, DarkMaskBuffers* buffers, BitMask* mask);

/// Halves the size in both directions by means of 2×2 pixels; an odd last column or row is dropped.
void HalveImage(ImageView<const std::uint8_t> grey, const DarkMaskKernels& kernels,
                Image<std::uint8_t>* half);

}  // namespace pleinair::tracker
