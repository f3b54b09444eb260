#include "app/leaf/leaf_swatch.h"

#include <array>
#include <cstdint>

#include "base/srgb.h"
#include "base/vector.h"
#include "compositor/leaf/leaf_color.h"

namespace pleinair::app {
namespace {

constexpr int kSide_px = 240, kFrame_px = 16;

std::array<std::uint8_t, 3> Srgb8Of(LinearRgb color) {
  return {Srgb8FromLinear(color.r), Srgb8FromLinear(color.g), Srgb8FromLinear(color.b)};
}

}  // namespace

RgbImage LeafSwatch(const scene::Leaf& leaf) {
  const auto [front, back] = compositor::ColorsOfLeaf(leaf, compositor::LeafIlluminant::D65());
  const std::array sides{Srgb8Of(front), Srgb8Of(back)};
  RgbImage image(3 * kFrame_px + 2 * kSide_px, 2 * kFrame_px + kSide_px, 3);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const int side = x / (kFrame_px + kSide_px);
      const bool is_leaf = side < 2 && x % (kFrame_px + kSide_px) >= kFrame_px && y >= kFrame_px &&
                           y < kFrame_px + kSide_px;
      for (int c = 0; c < 3; ++c) image(x, y, c) = is_leaf ? sides[side][c] : 255;
    }
  }
  return image;
}

}  // namespace pleinair::app
