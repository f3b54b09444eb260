#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/image.h"
#include "compositor/lens/disc_kernel.h"
#include "compositor/lens/disc_scatter.h"
#include "compositor/lens/hidden_surfaces.h"
#include "compositor/lens/pinhole_image.h"
#include "compositor/lens/pixel_surfaces.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/surfaces/image_tiles.h"

namespace pleinair::compositor {

/// What of an image lies behind its nearest surfaces and is needed.
struct NeededBehind {
  Image<float> max_dioptres;  ///< BehindNearest::dioptres, one channel.
  ImageTiles tiles;
};

/// Depth of field of one pinhole image. Each surface of each pixel is spread over its own circle of
/// confusion. Surfaces whose circles are alike add their coverage, since side by side they are
/// complete. Others cover one another from near to far, each completed by what it hides behind
/// itself. After Schedl and Wimmer 2012, with discs in place of Gaussians.
class LayeredLens {
 public:
  /// Begins an image, which must outlive Draw(). `within`: the tiles that are drawn. `fx`: render
  /// pixels.
  void Begin(const PinholeImage& image, const ThinLens& lens, double fx,
             std::span<const PixelRect> within);
  /// What Draw() needs of surfaces that others hide. Without tiles it needs none.
  const NeededBehind& behind() const { return behind_; }
  /// Draws the image. The pixels outside of `within` are left as they are. `hidden`: behind().
  LensImage Draw(const HiddenImage& hidden);
  /// Most layers of depth in a tile of the last image.
  int layers() const { return layers_; }

 private:
  struct Block {
    PixelRect pixels{}, drawn{};        // A tile, and the part of it that the lens changes.
    PixelRect window{};                 // What reaches into that.
    std::vector<HidingPixel> hiding{};  // In the window.
  };
  std::vector<SurfacePiece> PiecesOf(const Block& block, const HiddenImage& hidden) const;

  std::optional<DiscKernels> kernels_;
  ThinLens lens_;
  double fx_ = 0.0;
  const PinholeImage* image_ = nullptr;
  std::optional<PixelSurfaces> surfaces_;
  std::vector<Block> blocks_;
  NeededBehind behind_{{}, ImageTiles(0, 0)};
  int layers_ = 0;
};

}  // namespace pleinair::compositor
