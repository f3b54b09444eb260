#include "tracker/picture_target/picture_pyramid.h"

#include <algorithm>
#include <array>

#include "base/srgb.h"

namespace pleinair::tracker {
namespace {

constexpr double kBrightestShare = 0.02;
constexpr int kMinSide_px = 4;

/// Linear light that only the brightest pixels exceed.
float WhiteOf(ImageView<const std::uint8_t> picture) {
  std::array<std::size_t, 256> counts{};
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) ++counts[picture(x, y)];
  }
  const auto brightest = static_cast<std::size_t>(
      kBrightestShare * static_cast<double>(picture.width()) * picture.height());
  std::size_t above = 0;
  int code = 255;
  while (code > 1 && above + counts[code] <= brightest) above += counts[code--];
  return LinearFromSrgb8()[code];
}

}  // namespace

PicturePyramid::PicturePyramid(ImageView<const std::uint8_t> picture) {
  const float scale = 1.0F / WhiteOf(picture);
  Image<float> level(picture.width(), picture.height());
  for (int y = 0; y < level.height(); ++y) {
    for (int x = 0; x < level.width(); ++x) level(x, y) = scale * LinearFromSrgb8()[picture(x, y)];
  }
  levels_.push_back(std::move(level));
  while (std::min(levels_.back().width(), levels_.back().height()) >= 2 * kMinSide_px) {
    const Image<float>& from = levels_.back();
    Image<float> half(from.width() / 2, from.height() / 2);
    for (int y = 0; y < half.height(); ++y) {
      for (int x = 0; x < half.width(); ++x) {
        half(x, y) = 0.25F * (from(2 * x, 2 * y) + from(2 * x + 1, 2 * y) + from(2 * x, 2 * y + 1) +
                              from(2 * x + 1, 2 * y + 1));
      }
    }
    levels_.push_back(std::move(half));
  }
}

}  // namespace pleinair::tracker
