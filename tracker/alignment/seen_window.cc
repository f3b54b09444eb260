#include "tracker/alignment/seen_window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/srgb.h"
#include "tracker/homography.h"

namespace pleinair::tracker {
namespace {

constexpr std::uint8_t kBrightest = 252;  ///< The brightest code that does not count as clipped.

/// d code / d linear light of the sRGB curve, squared: the certainty of a code's linear light.
const std::array<float, 256>& CertaintyOfCode() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (int code = 0; code < 256; ++code) {
      const int low = std::max(0, code - 1), high = std::min(255, code + 1);
      const double slope =
          (high - low) / (255.0 * (LinearFromSrgb(high / 255.0) - LinearFromSrgb(low / 255.0)));
      values[code] = code > kBrightest ? 0.0F : static_cast<float>(slope * slope);
    }
    return values;
  }();
  return table;
}

}  // namespace

void TakeLinearWindow(const LensGrid& lens, ImageView<const std::uint8_t> grey,
                      const PixelWindow& window, SeenWindow* seen, Clipping clipping) {
  LookUpRays(lens, window, &seen->rays);
  seen->grey = grey;
  seen->value.resize(window.size());
  seen->certainty.resize(window.size());
  const auto& linear = LinearFromSrgb8();
  const auto& certainty = CertaintyOfCode();
  if (window.level == 0) {
    for (int y = 0; y < window.height; ++y) {
      const std::uint8_t* row = grey.row(window.y0 + y) + window.x0;
      const std::size_t at = static_cast<std::size_t>(y) * window.width;
      for (int x = 0; x < window.width; ++x) {
        seen->value[at + x] = linear[row[x]];
        seen->certainty[at + x] = certainty[row[x]];
      }
    }
    return;
  }
  const int side = 1 << window.level;
  const float share = 1.0F / static_cast<float>(side * side);
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      float sum = 0.0F, least = std::numeric_limits<float>::max(), most = 0.0F, certain = 0.0F;
      for (int j = 0; j < side; ++j) {
        const std::uint8_t* row = grey.row((window.y0 + y) * side + j) + (window.x0 + x) * side;
        for (int i = 0; i < side; ++i) {
          sum += linear[row[i]];
          least = std::min(least, certainty[row[i]]);
          most = std::max(most, certainty[row[i]]);
          certain += certainty[std::min(row[i], kBrightest)];
        }
      }
      const std::size_t at = static_cast<std::size_t>(y) * window.width + x;
      seen->value[at] = sum * share;
      seen->certainty[at] =
          clipping == Clipping::kByLight || !(most > 0.0F) ? least : certain * share;
    }
  }
}

void TakeCodeWindow(const LensGrid& lens, ImageView<const std::uint8_t> reduced,
                    const PixelWindow& window, SeenWindow* seen) {
  LookUpRays(lens, window, &seen->rays);
  seen->grey = {};
  seen->value.resize(window.size());
  seen->certainty.assign(window.size(), 1.0F);
  for (int y = 0; y < window.height; ++y) {
    const std::uint8_t* row = reduced.row(window.y0 + y) + window.x0;
    for (int x = 0; x < window.width; ++x) {
      seen->value[static_cast<std::size_t>(y) * window.width + x] =
          static_cast<float>(row[x]) * (1.0F / 255.0F);
    }
  }
}

void TakeEvenWindow(const LensGrid& lens, ImageView<const std::uint8_t> grey,
                    const PixelWindow& window, SeenWindow* seen) {
  LookUpRays(lens, window, &seen->rays);
  seen->grey = {};
  seen->value.resize(window.size());
  seen->certainty.resize(window.size());
  const auto& linear = LinearFromSrgb8();
  const int side = 1 << window.level;
  const float share = 1.0F / static_cast<float>(side * side);
  for (int y = 0; y < window.height; ++y) {
    float* value = &seen->value[static_cast<std::size_t>(y) * window.width];
    float* certain = &seen->certainty[static_cast<std::size_t>(y) * window.width];
    for (int x = 0; x < window.width; ++x) {
      const std::uint8_t* block = grey.row((window.y0 + y) * side) + (window.x0 + x) * side;
      float sum = 0.0F;
      std::uint8_t brightest = 0;
      for (int j = 0; j < side; ++j, block += grey.stride()) {
        for (int i = 0; i < side; ++i) {
          sum += linear[block[i]];
          brightest = std::max(brightest, block[i]);
        }
      }
      value[x] = sum * share;
      certain[x] = brightest > kBrightest ? 0.0F : 1.0F;
    }
  }
}

std::optional<PixelWindow> WindowOfSquare(const LensGrid& lens, const Mat3& plane_from_ideal,
                                          double side, int places, int width, int height, int level,
                                          int margin) {
  const Mat3 inverse = Adjugate(plane_from_ideal);
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  double sign = 0.0;
  for (int i = 0; i < 4 * places; ++i) {
    // Round the square: along its top, right, bottom and left.
    const double along = side * (i % places) / places;
    const Vec2 at = std::array<Vec2, 4>{
        Vec2{along, 0.0}, {side, along}, {side - along, side}, {0.0, side - along}}[i / places];
    const Vec3 ideal = inverse * Vec3{at.x, at.y, 1.0};
    if (i > 0 && ideal.z * sign <= 0.0) return std::nullopt;
    sign = ideal.z;
    const Vec2 pixel = lens.PixelOfIdeal({ideal.x / ideal.z, ideal.y / ideal.z});
    if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return std::nullopt;
    left = std::min(left, pixel.x);
    right = std::max(right, pixel.x);
    top = std::min(top, pixel.y);
    bottom = std::max(bottom, pixel.y);
  }
  const double scale = 1 << level;
  const auto first = [&](double full, int most) {
    return static_cast<int>(
        std::clamp(std::floor((full + 0.5) / scale - 0.5) - margin, 0.0, 1.0 * most));
  };
  const auto behind = [&](double full, int most) {
    return static_cast<int>(
        std::clamp(std::ceil((full + 0.5) / scale - 0.5) + 1 + margin, 0.0, 1.0 * most));
  };
  const int x0 = first(left, width >> level), y0 = first(top, height >> level);
  return PixelWindow{level, x0, y0, behind(right, width >> level) - x0,
                     behind(bottom, height >> level) - y0};
}

}  // namespace pleinair::tracker
