#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compositor/lens/disc_kernel.h"
#include "compositor/lens/disc_scatter.h"
#include "compositor/lens/pinhole_image.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/surfaces/image_tiles.h"

namespace pleinair::compositor {

/// Depth of field of one pinhole image. Each surface of each pixel is spread over its own circle of
/// confusion. Surfaces whose circles are alike add their coverage, since side by side they are
/// complete. Others cover one another from near to far, each completed by what it hides behind
/// itself (HiddenSurfaces()). After Schedl and Wimmer 2012, with discs in place of Gaussians.
class LayeredLens {
 public:
  /// Draws the tiles `within`; the other pixels are left as they are. `fx`: render pixels.
  LensImage Draw(const PinholeImage& image, const ThinLens& lens, double fx,
                 std::span<const PixelRect> within);
  /// Most layers of depth in a tile of the last image.
  int layers() const { return layers_; }

 private:
  std::optional<DiscKernels> kernels_;
  int layers_ = 0;
};

}  // namespace pleinair::compositor
