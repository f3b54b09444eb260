#include "compositor/models/texture_conversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pleinair::compositor {
namespace {

// Height of white, in widths of the picture, for a bump of one.
constexpr double kHeightOfWhite = 0.01;

std::uint8_t Unorm(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

/// The red channel at a pixel of a picture that is scaled to `width` by `height`.
std::uint8_t Sampled(const Image<std::uint8_t>& image, int x, int y, int width, int height) {
  if (image.empty()) return 255;
  const auto scaled = [](int at, int from, int to) {
    return static_cast<int>(static_cast<std::int64_t>(at) * to / from);
  };
  return image(scaled(x, width, image.width()), scaled(y, height, image.height()), 0);
}

}  // namespace

bool LooksLikeNormalMap(const Image<std::uint8_t>& image) {
  if (image.empty() || image.channels() < 3) return false;
  std::array<double, 3> mean{};
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (int c = 0; c < 3; ++c) mean[static_cast<std::size_t>(c)] += image(x, y, c);
    }
  }
  const double scale = 1.0 / (255.0 * image.width() * image.height());
  for (double& value : mean) value *= scale;
  const auto is_near_half = [](double value) { return value > 0.4 && value < 0.6; };
  return is_near_half(mean[0]) && is_near_half(mean[1]) && mean[2] > 0.7;
}

Image<std::uint8_t> NormalMapFromHeight(const Image<std::uint8_t>& heights, float bump) {
  const int width = heights.width(), height = heights.height();
  Image<std::uint8_t> normals(width, height, 3);
  const double scale = static_cast<double>(bump) * kHeightOfWhite * width / 255.0;
  for (int y = 0; y < height; ++y) {
    const int above = (y + height - 1) % height, below = (y + 1) % height;
    for (int x = 0; x < width; ++x) {
      const int left = (x + width - 1) % width, right = (x + 1) % width;
      // Rows run downwards, green upwards.
      const double slope_x = 0.5 * scale * (heights(right, y, 0) - heights(left, y, 0));
      const double slope_up = 0.5 * scale * (heights(x, above, 0) - heights(x, below, 0));
      const double length = std::sqrt(slope_x * slope_x + slope_up * slope_up + 1.0);
      normals(x, y, 0) = Unorm(0.5 - 0.5 * slope_x / length);
      normals(x, y, 1) = Unorm(0.5 - 0.5 * slope_up / length);
      normals(x, y, 2) = Unorm(0.5 + 0.5 / length);
    }
  }
  return normals;
}

Image<std::uint8_t> CombinedRoughnessAndMetal(const Image<std::uint8_t>& roughness,
                                              const Image<std::uint8_t>& metal) {
  const int width = std::max(roughness.width(), metal.width());
  const int height = std::max(roughness.height(), metal.height());
  Image<std::uint8_t> combined(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      combined(x, y, 0) = 0;
      combined(x, y, 1) = Sampled(roughness, x, y, width, height);
      combined(x, y, 2) = Sampled(metal, x, y, width, height);
    }
  }
  return combined;
}

}  // namespace pleinair::compositor
