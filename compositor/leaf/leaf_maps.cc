#include "compositor/leaf/leaf_maps.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pleinair::compositor {
namespace {

/// What a kind of tissue has of the leaf's properties.
struct TissueShares {
  double chlorophyll, carotenoids, brown, gloss, thickness;
};
constexpr std::array<TissueShares, 3> kTissues = {{
    {0.30, 1.00, 1.00, 1.00, 1.9},  // Main vein.
    {0.55, 0.95, 0.80, 0.80, 1.4},  // Secondary veins.
    {1.00, 0.85, 0.60, 0.60, 1.0},  // Mesophyll.
}};

std::uint8_t MapCode(double value, double code_of_one) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value * code_of_one, 0.0, 255.0)));
}

}  // namespace

LeafMaps MapsOfStructure(ImageView<const std::uint8_t> structure) {
  const int width = structure.width(), height = structure.height();
  LeafMaps maps{Image<std::uint8_t>(width, height, 3), Image<std::uint8_t>(width, height),
                Image<std::uint8_t>(width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::array<double, 3> share{};
      double sum = 0.0;
      for (int c = 0; c < 3; ++c) sum += share[c] = structure(x, y, c);
      if (sum == 0.0) share[2] = sum = 1.0;
      TissueShares mixed{};
      for (std::size_t c = 0; c < share.size(); ++c) {
        const double weight = share[c] / sum;
        mixed.chlorophyll += weight * kTissues[c].chlorophyll;
        mixed.carotenoids += weight * kTissues[c].carotenoids;
        mixed.brown += weight * kTissues[c].brown;
        mixed.gloss += weight * kTissues[c].gloss;
        mixed.thickness += weight * kTissues[c].thickness;
      }
      maps.pigment(x, y, 0) = MapCode(mixed.chlorophyll, 255.0);
      maps.pigment(x, y, 1) = MapCode(mixed.carotenoids, 255.0);
      maps.pigment(x, y, 2) = MapCode(mixed.brown, 255.0);
      maps.gloss(x, y) = MapCode(mixed.gloss, 255.0);
      maps.thickness(x, y) = MapCode(mixed.thickness, kThicknessCodeOfOne);
    }
  }
  return maps;
}

}  // namespace pleinair::compositor
