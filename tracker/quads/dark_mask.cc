#include "tracker/quads/dark_mask.h"

#include <algorithm>
#include <array>

namespace pleinair::tracker {
namespace {

/// Minimum contrast in 8-bit values, for the darkest exposures: quantisation alone gives two.
constexpr int kMinContrast = 8;

void TileExtremes(const std::uint8_t* pixels, std::ptrdiff_t stride, int width,
                  std::uint8_t* tile_min, std::uint8_t* tile_max) {
  for (int x = 0; x < width; x += kTile) {
    std::uint8_t least = 255, greatest = 0;
    for (int j = 0; j < kTile; ++j) {
      for (int i = 0; i < kTile; ++i) {
        const std::uint8_t value = pixels[j * stride + x + i];
        least = std::min(least, value);
        greatest = std::max(greatest, value);
      }
    }
    std::fill_n(tile_min + x, kTile, least);
    std::fill_n(tile_max + x, kTile, greatest);
  }
}

/// Rounded up, as the processor's instruction.
std::uint8_t Mean(int a, int b) { return static_cast<std::uint8_t>((a + b + 1) / 2); }

void Thresholds(const std::uint8_t* const min_rows[3], const std::uint8_t* const max_rows[3],
                int width, DarkContrast contrast, std::uint8_t* /*column_min*/,
                std::uint8_t* /*column_max*/, std::uint8_t* thresholds) {
  for (int x = 0; x < width; ++x) {
    std::uint8_t least = 255, greatest = 0;
    for (int j = 0; j < 3; ++j) {
      for (int dx = -kTile; dx <= kTile; dx += kTile) {
        least = std::min(least, min_rows[j][x + dx]);
        greatest = std::max(greatest, max_rows[j][x + dx]);
      }
    }
    const int range = greatest - least;
    int share = greatest;
    for (int i = 0; i < contrast.halvings; ++i) share = Mean(share, 0);
    const bool observed = range >= contrast.codes && range >= share;
    std::uint8_t threshold = least;  // A binary fraction of the way, lowest digit first.
    for (int digit = 1; digit < 8; digit *= 2) {
      threshold = Mean(threshold, (contrast.eighths & digit) != 0 ? greatest : least);
    }
    thresholds[x] = observed ? threshold : std::uint8_t{0};
  }
}

void Compare(const std::uint8_t* pixels, const std::uint8_t* thresholds, int width,
             std::uint8_t* bits) {
  for (int x = 0; x < width; x += 8) {
    unsigned byte = 0;
    for (int i = 0; i < 8 && x + i < width; ++i) {
      byte |= static_cast<unsigned>(pixels[x + i] < thresholds[x + i]) << i;
    }
    bits[x / 8] = static_cast<std::uint8_t>(byte);
  }
}

void Halve(const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* means) {
  for (int x = 0; x < width; ++x) {
    means[x] = static_cast<std::uint8_t>(
        (upper[2 * x] + upper[2 * x + 1] + lower[2 * x] + lower[2 * x + 1] + 2) / 4);
  }
}

/// Range of values within tiles where the image is uniform: the lowest fifth of the tiles. Sixteen
/// samples of Gaussian noise span 3.5 standard deviations on average.
int TileNoise(const DarkMaskBuffers& buffers, int width, int tile_rows, int stride) {
  std::array<int, 256> count{};
  int tiles = 0;
  for (int row = 0; row < tile_rows; ++row) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(row + 1) * stride + kTile;
    const std::uint8_t* least = buffers.tile_min.data() + at;
    const std::uint8_t* greatest = buffers.tile_max.data() + at;
    for (int x = (row % 4) * kTile; x < width; x += 4 * kTile) {  // A quarter of the tiles
                                                                  // suffices.
      ++count[greatest[x] - least[x]];
      ++tiles;
    }
  }
  int range = 0;
  for (int below = count[0]; range < 255 && below * 5 < tiles; below += count[++range]) {
  }
  return range;
}

}  // namespace

const DarkMaskKernels& ScalarDarkMaskKernels() {
  static constexpr DarkMaskKernels kKernels{TileExtremes, Thresholds, Compare, Halve};
  return kKernels;
}

void ComputeDarkMask(ImageView<const std::uint8_t> grey, DarkContrast most,
                     const DarkMaskKernels& kernels, DarkMaskBuffers* buffers, BitMask* mask) {
  const int width = grey.width() / kTile * kTile, tile_rows = grey.height() / kTile;
  mask->width = grey.width();
  mask->height = grey.height();
  mask->words_per_row = (grey.width() + 63) / 64;
  mask->words.assign(static_cast<std::size_t>(mask->words_per_row) * grey.height(), 0);
  if (width == 0 || tile_rows == 0) return;

  // One tile of neutral padding on all sides.
  const int stride = width + 2 * kTile;
  const std::size_t padded = static_cast<std::size_t>(stride) * (tile_rows + 2);
  buffers->tile_min.resize(padded);
  buffers->tile_max.resize(padded);
  buffers->threshold.resize(width);
  buffers->column_min.resize(stride);
  buffers->column_max.resize(stride);
  const auto pad = [&](std::uint8_t* plane, std::uint8_t neutral) {
    std::fill_n(plane, stride + kTile, neutral);
    for (int row = 1; row <= tile_rows; ++row) {
      std::fill_n(plane + static_cast<std::ptrdiff_t>(row + 1) * stride - kTile, 2 * kTile,
                  neutral);
    }
    std::fill_n(plane + static_cast<std::ptrdiff_t>(tile_rows + 1) * stride, stride, neutral);
  };
  pad(buffers->tile_min.data(), 255);
  pad(buffers->tile_max.data(), 0);

  for (int row = 0; row < tile_rows; ++row) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(row + 1) * stride + kTile;
    kernels.tile_extremes(grey.row(row * kTile), grey.stride(), width,
                          buffers->tile_min.data() + at, buffers->tile_max.data() + at);
  }
  const int noise = TileNoise(*buffers, width, tile_rows, stride);
  // 3×3 tiles of noise alone span 5.3 standard deviations on average, one tile 3.5; the additional
  // margin suppresses speckle.
  const DarkContrast contrast{
      std::clamp(noise * 5 / 2, kMinContrast, std::max(most.codes, kMinContrast)), most.halvings,
      most.eighths};

  for (int row = 0; row < tile_rows; ++row) {
    const std::uint8_t *least[3], *greatest[3];
    for (int j = 0; j < 3; ++j) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(row + j) * stride + kTile;
      least[j] = buffers->tile_min.data() + at;
      greatest[j] = buffers->tile_max.data() + at;
    }
    kernels.thresholds(least, greatest, width, contrast, buffers->column_min.data(),
                       buffers->column_max.data(), buffers->threshold.data());
    for (int j = 0; j < kTile; ++j) {
      const int y = row * kTile + j;
      kernels.compare(
          grey.row(y), buffers->threshold.data(), width,
          reinterpret_cast<std::uint8_t*>(mask->words.data() +
                                          static_cast<std::ptrdiff_t>(y) * mask->words_per_row));
    }
  }
}

void HalveImage(ImageView<const std::uint8_t> grey, const DarkMaskKernels& kernels,
                Image<std::uint8_t>* half) {
  const int width = grey.width() / 2, height = grey.height() / 2;
  if (half->width() != width || half->height() != height)
    *half = Image<std::uint8_t>(width, height);
  for (int y = 0; y < height; ++y) {
    kernels.halve(grey.row(2 * y), grey.row(2 * y + 1), width, half->view().row(y));
  }
}

}  // namespace pleinair::tracker
