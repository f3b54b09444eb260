#include "tracker/surf_golay/print_windows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tracker/surf_golay/print_square.h"

namespace pleinair::tracker {
namespace {

constexpr double kFineSide_px = 100.0;  ///< Of a print that is measured.
/// Blur of a reduced picture below which its edges tell their places no more: a pixel then sees
/// much the same wherever in it the edge lies.
constexpr double kSharpestReduced_px = 0.2;
constexpr double kMostClipped = 0.08;  ///< Share of pixels.
constexpr std::size_t kMostPixels = 400'000;

}  // namespace

void PrintWindows::SetPicture(ImageView<const std::uint8_t> grey) {
  grey_ = grey;
  reduced_.SetPicture(grey);
}

double PrintWindows::SidePx(const Mat3& modules_from_ideal) {
  const std::array<Vec2, 4> corners = SquareCornersIdeal(modules_from_ideal);
  double longest = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double side = Norm(corners[i] - corners[(i + 1) % 4]);
    if (!std::isfinite(side)) return 0.0;
    longest = std::max(longest, side);
  }
  return longest;
}

bool PrintWindows::Window(const Mat3& modules_from_ideal, int level, PixelWindow* window) const {
  const std::optional<PixelWindow> found = WindowOfSquare(lens_, modules_from_ideal, sg::kPrint, 1,
                                                          grey_.width(), grey_.height(), level, 0);
  if (!found) return false;
  *window = *found;
  return window->width > 3 && window->height > 3 && window->size() < kMostPixels;
}

bool PrintWindows::CoarseWindow(const Mat3& modules_from_ideal, double most_side_px,
                                PixelWindow* window) const {
  const double side = SidePx(modules_from_ideal);
  int level = 0;
  while (side / (1 << level) > most_side_px && level + 1 < ReducedPictures::kLevels) ++level;
  return Window(modules_from_ideal, level, window);
}

bool PrintWindows::TakeCoarse(const Mat3& modules_from_ideal, double most_side_px,
                              PixelWindow* window, SeenWindow* seen) {
  if (!CoarseWindow(modules_from_ideal, most_side_px, window)) return false;
  TakeCodeWindow(lens_, reduced_.Level(window->level), *window, seen);
  return true;
}

bool PrintWindows::TakeCoarseLight(const Mat3& modules_from_ideal, double most_side_px,
                                   PixelWindow* window, SeenWindow* seen) {
  if (!CoarseWindow(modules_from_ideal, most_side_px, window)) return false;
  TakeEvenWindow(lens_, grey_, *window, seen);
  return true;
}

bool PrintWindows::TakeFine(const BlockFitState& state, PixelWindow* window, SeenWindow* seen) {
  const double side = SidePx(state.modules_from_ideal);
  int level = 0;
  while (side / (1 << level) > kFineSide_px && state.blur_px / (2 << level) > kSharpestReduced_px &&
         level + 1 < ReducedPictures::kLevels) {
    ++level;
  }
  level = std::min(std::max(level, halvings_for_noise_), ReducedPictures::kLevels - 1);
  // The largest prints take more pixels than there is room for.
  while (!Window(state.modules_from_ideal, level, window)) {
    if (++level >= ReducedPictures::kLevels) return false;
  }
  for (;; --level) {
    const bool noisy = halvings_for_noise_ > 0;
    TakeLinearWindow(lens_, grey_, *window, seen, noisy ? Clipping::kByNoise : Clipping::kByLight);
    if (level == 0) return true;
    // A reduced pixel is lost when one of its pixels is clipped by light: where many are, the
    // picture's own tell more.
    const auto clipped = std::count(seen->certainty.begin(), seen->certainty.end(), 0.0F);
    if (clipped < kMostClipped * static_cast<double>(window->size())) return true;
    if (noisy) return false;
    PixelWindow finer;
    if (!Window(state.modules_from_ideal, level - 1, &finer)) return true;
    *window = finer;
  }
}

}  // namespace pleinair::tracker
