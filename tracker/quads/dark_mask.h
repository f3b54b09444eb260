#pragma once

// Internal: between the .cc files of this module; not installed.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/image.h"

namespace pleinair::tracker {

/// One bit a pixel, 64 pixels a word, the lowest bit leftmost; a set bit is a dark pixel.
struct BitMask {
  int width = 0, height = 0, words_per_row = 0;
  std::vector<std::uint64_t> words;

  const std::uint64_t* row(int y) const {
    return words.data() + static_cast<std::ptrdiff_t>(y) * words_per_row;
  }
  bool operator()(int x, int y) const { return (row(y)[x >> 6] >> (x & 63) & 1) != 0; }
};

/// Buffers of ComputeDarkMask, kept between images so that it does not allocate.
/// Rows of tiles hold each tile's value once for each of its columns.
struct DarkMaskBuffers {
  std::vector<std::uint8_t> tile_min, tile_max;
  std::vector<std::uint8_t> threshold;
  std::vector<std::uint8_t> column_min, column_max;
};

inline constexpr int kTile = 4;  ///< Edge of a tile in pixels.

/// How far apart least and greatest value of a neighbourhood must be, and what is dark between
/// them.
struct DarkContrast {
  int codes = 0;     ///< At least so many.
  int halvings = 2;  ///< And at least the greatest value halved so often.
  int eighths = 4;   ///< Dark is what lies less than so many eighths of the way above the least.
};

/// What one row of tiles does; the SIMD version and its scalar reference agree bit for bit.
struct DarkMaskKernels {
  /// Least and greatest value of each tile over four rows of `width` pixels (a multiple of kTile),
  /// written once for each column of the tile.
  void (*tile_extremes)(const std::uint8_t* pixels, std::ptrdiff_t stride, int width,
                        std::uint8_t* tile_min, std::uint8_t* tile_max);
  /// Thresholds of one row of tiles from the extremes of 3×3 tiles where they differ by
  /// `contrast`, else 0.
  /// The three rows hold a tile's width of padding before and behind. `column_*` is scratch of the
  /// same length as they.
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
/// The best that this machine has (Highway).
const DarkMaskKernels& SimdDarkMaskKernels();

/// Marks pixels that are dark beside what lies around them, as AprilTag 3 does (Wang & Olson,
/// "AprilTag 2: Efficient and robust fiducial detection", IROS 2016, section III-A: extremes of 4×4
/// tiles, spread to the neighbours, threshold half way). Tiles whose neighbourhood has little
/// contrast hold no dark pixel. Deviations: the threshold need not be half way, and little is not a
/// fixed number of codes but little beside the noise of this image (up to `most.codes`) and
/// beside the neighbourhood's own brightness, so that dark exposures work and noise makes no
/// speckle. The up to three last columns and rows that fill no tile are never dark.
void ComputeDarkMask(ImageView<const std::uint8_t> grey, DarkContrast most,
                     const DarkMaskKernels& kernels, DarkMaskBuffers* buffers, BitMask* mask);

/// Half the size in both directions, means of 2×2 pixels; an odd last column or row is left out.
void HalveImage(ImageView<const std::uint8_t> grey, const DarkMaskKernels& kernels,
                Image<std::uint8_t>* half);

}  // namespace pleinair::tracker
