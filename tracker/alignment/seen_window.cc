#include "tracker/alignment/seen_window.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/srgb.h"

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

}  // namespace pleinair::tracker
