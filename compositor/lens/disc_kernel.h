#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "compositor/lens/thin_lens.h"

namespace pleinair::compositor {

/// The image of a stop that is out of focus, as weights of pixels that sum to 1. Weights along a
/// row are stored as steps: a sum along the row restores them. A disc of diameter d then costs
/// about d rows of a few steps in place of d² pixels.
struct DiscKernel {
  /// By how much the weight rises from one pixel to the next.
  struct Step {
    std::int16_t x;  ///< First pixel with the new weight, from the kernel's centre.
    float rise;
  };
  struct Row {
    std::int16_t y;              ///< From the kernel's centre.
    std::uint16_t first, count;  ///< Steps, by increasing x.
  };
  std::vector<Row> rows;
  std::vector<Step> steps;
  int reach_px = 0;  ///< Largest |x| or |y| of a pixel with weight.
};

/// The part of a pixel that a surface covers: all of it, or one to a side.
struct PixelPart {
  int x = 0, y = 0;  ///< −1, 0, 1: the side.
  bool is_whole = true;
};

/// Kernels of a stop by circle of confusion. The circles are in steps of an eighth of a pixel up to
/// 8 pixels and of a quarter beyond.
class DiscKernels {
 public:
  /// Larger circles of confusion are drawn as ones of this diameter.
  static constexpr double kMaxCircle_px = 128.0;
  /// Smaller ones are not drawn.
  static constexpr double kMinCircle_px = 0.3;

  /// Most pixels that a circle of confusion reaches along an axis.
  static int Reach_px(double circle_px) {
    return static_cast<int>(std::ceil(0.5 * std::fabs(circle_px))) + 1;
  }

  explicit DiscKernels(const LensStop& stop);

  const LensStop& stop() const { return stop_; }
  /// Number of the kernel for a circle of confusion, SignedCircle_px(): odd numbers of blades point
  /// the other way before the focus. Parts of pixels have kernels of their own up to circles of 8
  /// pixels. A part is half a pixel wide.
  static int IndexOf(double signed_circle_px, PixelPart part);
  /// Makes a kernel if there is none yet. Not to be called while others read.
  void Prepare(int index);
  /// Requires Prepare() of it.
  const DiscKernel& Of(int index) const { return *made_[static_cast<std::size_t>(index)]; }

 private:
  LensStop stop_;
  std::vector<std::unique_ptr<const DiscKernel>> made_;  // Null: not prepared.
};

}  // namespace pleinair::compositor
