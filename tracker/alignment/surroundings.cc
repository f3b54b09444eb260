#include "tracker/alignment/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/srgb.h"

namespace pleinair::tracker {
namespace {

/// Radius of a pixel's footprint beyond its own half, in standard deviations of the blur. Width of
/// the quiet zone that is always used (block_fit.cc).
constexpr double kSeen_sigmas = 2.5, kKeptQuiet_modules = 2.4;
/// Distance beyond the marker's edge, in pixels, where hardly any light of the marker is left.
constexpr float kBeyond_px = 1.2F;

/// Share of a pixel's light that comes from beyond a straight edge `d` pixels from its centre, for
/// 0 to kReach_px. It is ∫Φ of the blur's Gaussian over the pixel's box.
class LightFromBeyond {
 public:
  static constexpr int kPerPixel = 16;
  explicit LightFromBeyond(double blur_px) {
    const double sigma = std::max(blur_px, 0.1);
    reach_px_ = static_cast<float>(std::min(0.5 + kSeen_sigmas * sigma, kMax - 0.2));
    const auto primitive = [&](double x) {  // Primitive of Φ(-x/σ), from minus infinity.
      const double z = x / sigma;
      return x * 0.5 * std::erfc(z / std::numbers::sqrt2) -
             sigma * std::exp(-0.5 * z * z) * 0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2;
    };
    for (int i = 0; i < static_cast<int>(share_.size()); ++i) {
      const double d = static_cast<double>(i) / kPerPixel;
      share_[i] = static_cast<float>(primitive(d + 0.5) - primitive(d - 0.5));
    }
  }
  float reach_px() const { return reach_px_; }
  float At(float d_px) const {
    const long last = static_cast<long>(share_.size()) - 1;
    return share_[std::clamp(std::lrint(d_px * kPerPixel), 0L, last)];
  }

 private:
  static constexpr double kMax = 4.0;
  std::array<float, static_cast<int>(kMax* kPerPixel)> share_{};
  float reach_px_ = 0.0F;
};

/// Linear light of the image's pixels, bilinear; the image is extended by its edge pixels.
float LightAt(const ImageView<const std::uint8_t>& grey, float x, float y) {
  const std::array<float, 256>& linear = LinearFromSrgb8();
  // In this order NaN becomes 0. The last column is bounded as an integer, because in wide images a
  // float cannot represent a fraction less than it.
  x = std::min(std::max(0.0F, x), static_cast<float>(grey.width() - 1));
  y = std::min(std::max(0.0F, y), static_cast<float>(grey.height() - 1));
  const int column = std::min(static_cast<int>(x), grey.width() - 2);
  const int row = std::min(static_cast<int>(y), grey.height() - 2);
  const float fx = x - static_cast<float>(column), fy = y - static_cast<float>(row);
  const std::uint8_t* upper = grey.row(row) + column;
  const std::uint8_t* lower = upper + grey.stride();
  const float above = linear[upper[0]] + fx * (linear[upper[1]] - linear[upper[0]]);
  const float below = linear[lower[0]] + fx * (linear[lower[1]] - linear[lower[0]]);
  return above + fy * (below - above);
}

}  // namespace

bool SurroundingsShow(double module_px, double blur_px) {
  return 0.5 + kSeen_sigmas * blur_px > kKeptQuiet_modules * module_px;
}

void AddSurroundings(const MarkerPattern& pattern, const ObservedPatch& observed,
                     const PlaneMap& map, const std::vector<RowRange>& ranges, double blur_px,
                     const std::vector<BlockLight>& lights, int blocks_along,
                     PredictedImage* image) {
  const PixelWindow& window = observed.rays.window;
  if (window.level != 0 || observed.grey.width() < 2 || observed.grey.height() < 2) return;
  const LightFromBeyond beyond(blur_px);
  const float modules = static_cast<float>(pattern.modules);
  const float per_block = static_cast<float>(blocks_along) / modules;
  const auto index = [&](float at) {
    return std::clamp(static_cast<int>(at * per_block), 0, blocks_along - 1);
  };
  for (int y = 0; y < window.height; ++y) {
    for (int x = ranges[y].begin; x < ranges[y].end; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * window.width + x;
      const float column = map.column[at], row = map.row[at];
      if (!(column > 0.0F && row > 0.0F && column < modules && row < modules)) continue;
      const float left = std::min(column, modules - column), top = std::min(row, modules - row);
      const float by_column2 =
          map.column_x[at] * map.column_x[at] + map.column_y[at] * map.column_y[at];
      const float by_row2 = map.row_x[at] * map.row_x[at] + map.row_y[at] * map.row_y[at];
      const float reach2 = beyond.reach_px() * beyond.reach_px();
      const bool near_column = left * left < reach2 * by_column2;
      const bool near_row = top * top < reach2 * by_row2;
      if (!near_column && !near_row) continue;
      float kept = 1.0F, to_x = 0.0F, to_y = 0.0F;
      const auto edge = [&](float inside, float by_2, bool first, float by_x, float by_y) {
        const float per_module = 1.0F / std::sqrt(by_2), d = inside * per_module;
        kept *= 1.0F - beyond.At(d);
        const float out = (first ? -1.0F : 1.0F) * (d + kBeyond_px) * per_module;
        to_x += out * by_x;
        to_y += out * by_y;
      };
      if (near_column) {
        edge(left, by_column2, column < modules - column, map.column_x[at], map.column_y[at]);
      }
      if (near_row) edge(top, by_row2, row < modules - row, map.row_x[at], map.row_y[at]);
      const BlockLight& light = lights[index(row) * blocks_along + index(column)];
      if (!(light.gain > 0.0F)) continue;
      const float there = LightAt(observed.grey, static_cast<float>(window.x0 + x) + to_x,
                                  static_cast<float>(window.y0 + y) + to_y);
      const float share = (there - light.offset) / light.gain;
      image->white[at] += (1.0F - kept) * (std::clamp(share, -1.0F, 3.0F) - 1.0F);
    }
  }
}

}  // namespace pleinair::tracker
