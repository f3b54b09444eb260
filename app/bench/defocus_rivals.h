#pragma once

#include <cstdint>
#include <vector>

#include "app/bench/defocus_scenes.h"
#include "base/image.h"

namespace pleinair::app {

/// What a pinhole sees of the boards, by place in the pixel: up to `kPeels` boards, nearest first,
/// and −1 behind them.
class PeeledBoards {
 public:
  static constexpr int kPeels = 4, kSide = 4;

  PeeledBoards(const DefocusScene& scene, int width, int height);

  int width() const { return board_.width(); }
  int height() const { return board_.height(); }
  /// Board of a peel at a place of a pixel, 0…15; −1: there is none.
  int Board(int x, int y, int place, int peel) const { return board_(x, y, place * kPeels + peel); }

 private:
  Image<std::int8_t> board_;
};

/// Light of boards as DrawGaussianLayers() draws it.
struct GaussianLayers {
  Image<float> light;  ///< Linear, one channel.
  int layers = 0;
};

/// Draws by layers of depth, each blurred by a Gaussian. Layers are split by matting functions.
/// D. Schedl, M. Wimmer: A layered depth-of-field method for solving partial occlusion (WSCG 2012),
/// Eqs. 9 to 13. `in_cascade`: as they do it; else each layer is blurred for itself.
GaussianLayers DrawGaussianLayers(const DefocusScene& scene, const PeeledBoards& seen,
                                  bool in_cascade);

/// Draws by gathering with one depth a pixel, as Filament and Blender's compositor publish it. Each
/// neighbour counts where its circle of confusion reaches. One that lies farther counts only as far
/// as the pixel's own circle.
Image<float> DrawGathered(const DefocusScene& scene, const PeeledBoards& seen);

/// Standard deviation of the n-th layer from the focus, pixels: Gaussians of 1, 2 … n pixels in a
/// row.
double SigmaOfLayer(int n);

/// Weights of the paper's matting functions (Eqs. 3 and 4, misprints mended) at a circle of
/// confusion, by layer from the nearest. `is_peeled`: without the soft far end.
class MattingFunctions {
 public:
  /// Layers from the nearest circle to the farthest; layer `focus()` is sharp.
  MattingFunctions(double nearest_px, double farthest_px, const compositor::ThinLens& lens,
                   double fx);

  int layers() const { return static_cast<int>(anchors_.size()) - 1; }
  int focus() const { return focus_; }
  double Weight(int layer, double distance_m, bool is_peeled) const;

 private:
  std::vector<double> anchors_;  // z_0 … z_K, metres: layer k lies between k and k + 1.
  int focus_ = 0;
};

}  // namespace pleinair::app
