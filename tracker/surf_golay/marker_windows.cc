#include "tracker/surf_golay/marker_windows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tracker/surf_golay/marker_square.h"

namespace pleinair::tracker {
namespace {

constexpr double kFineSide_px = 100.0;  ///< Maximum side at which a marker is measured, unless its
                                        ///< blur is too small for a reduced image.
/// Minimum blur in a reduced image. Below it edges do not determine their position: a pixel's value
/// hardly depends on where in the pixel the edge lies.
constexpr double kSharpestReduced_px = 0.2;
constexpr double kMaxClippedShare = 0.08;  ///< Share of pixels.
constexpr std::size_t kMaxPixels = 400'000;

}  // namespace

void MarkerWindows::SetImage(ImageView<const std::uint8_t> grey) {
  grey_ = grey;
  reduced_.SetImage(grey);
}

double MarkerWindows::SidePx(const Mat3& modules_from_undistorted) {
  const std::array<Vec2, 4> corners = UndistortedSquareCorners(modules_from_undistorted);
  double longest = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double side = Norm(corners[i] - corners[(i + 1) % 4]);
    if (!std::isfinite(side)) return 0.0;
    longest = std::max(longest, side);
  }
  return longest;
}

bool MarkerWindows::Window(const Mat3& modules_from_undistorted, int level,
                           PixelWindow* window) const {
  const std::optional<PixelWindow> found = WindowOfSquare(
      lens_, modules_from_undistorted, sg::kModules, 1, grey_.width(), grey_.height(), level, 0);
  if (!found) return false;
  *window = *found;
  return window->width > 3 && window->height > 3 && window->size() < kMaxPixels;
}

bool MarkerWindows::CoarseWindow(const Mat3& modules_from_undistorted, double max_side_px,
                                 PixelWindow* window) const {
  const double side = SidePx(modules_from_undistorted);
  int level = 0;
  while (side / (1 << level) > max_side_px && level + 1 < ReducedImages::kLevels) ++level;
  return Window(modules_from_undistorted, level, window);
}

bool MarkerWindows::TakeCoarse(const Mat3& modules_from_undistorted, double max_side_px,
                               PixelWindow* window, ObservedPatch* observed) {
  if (!CoarseWindow(modules_from_undistorted, max_side_px, window)) return false;
  TakeCodeWindow(lens_, reduced_.Level(window->level), *window, observed);
  return true;
}

bool MarkerWindows::TakeCoarseLight(const Mat3& modules_from_undistorted, double max_side_px,
                                    PixelWindow* window, ObservedPatch* observed) {
  if (!CoarseWindow(modules_from_undistorted, max_side_px, window)) return false;
  TakeEvenWindow(lens_, grey_, *window, observed);
  return true;
}

bool MarkerWindows::TakeFine(const BlockFitState& state, PixelWindow* window,
                             ObservedPatch* observed) {
  const double side = SidePx(state.modules_from_undistorted);
  int level = 0;
  while (side / (1 << level) > kFineSide_px && state.blur_px / (2 << level) > kSharpestReduced_px &&
         level + 1 < ReducedImages::kLevels) {
    ++level;
  }
  level = std::min(std::max(level, halvings_for_noise_), ReducedImages::kLevels - 1);
  // The largest markers have more pixels than the maximum.
  while (!Window(state.modules_from_undistorted, level, window)) {
    if (++level >= ReducedImages::kLevels) return false;
  }
  for (;; --level) {
    const bool noisy = halvings_for_noise_ > 0;
    TakeLinearWindow(lens_, grey_, *window, observed,
                     noisy ? Clipping::kByNoise : Clipping::kByLight);
    if (level == 0) return true;
    // A reduced pixel is lost if light clips one of its pixels. Where many are lost, the full-size
    // pixels are better evidence.
    const auto clipped =
        std::count(observed->inverse_variance.begin(), observed->inverse_variance.end(), 0.0F);
    if (clipped < kMaxClippedShare * static_cast<double>(window->size())) return true;
    if (noisy) return false;
    PixelWindow finer;
    if (!Window(state.modules_from_undistorted, level - 1, &finer)) return true;
    *window = finer;
  }
}

}  // namespace pleinair::tracker
