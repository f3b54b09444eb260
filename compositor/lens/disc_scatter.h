#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "compositor/lens/disc_kernel.h"
#include "compositor/lens/lens_layers.h"

namespace pleinair::compositor {

/// A piece of surface in a pixel, with what a lens spreads.
struct SurfacePiece {
  /// Premultiplied display-linear color of objects and their coverage; change of the light of real
  /// surfaces, (ratio − 1) times coverage, and the coverage of occluders.
  float values[8];
  std::int16_t x, y;    ///< Pixel, from the block's first one.
  std::int16_t kernel;  ///< DiscKernels::IndexOf().
  std::int16_t layer;   ///< LayerOf().
};

/// Sums of pieces by layer over a square block of pixels.
class BlockLayers {
 public:
  static constexpr int kSide_px = 64;
  static constexpr int kValues = 8;

  /// Spreads pieces by their prepared kernels. Parts beside the block are cut off.
  BlockLayers(std::span<const SurfacePiece> pieces, const DiscKernels& kernels);

  /// The layers with anything in them, from near to far.
  const std::vector<int>& layers() const { return layers_; }
  /// The sums of such a layer at a pixel, `kValues` of them.
  const float* At(int layer, int x, int y) const {
    return sums_[static_cast<std::size_t>(layer)].data() +
           (static_cast<std::ptrdiff_t>(y) * kSide_px + x) * kValues;
  }

 private:
  std::vector<int> layers_;
  std::array<std::vector<float>, kLensLayers> sums_;  // Empty: nothing in this layer.
};

}  // namespace pleinair::compositor
