#pragma once

#include <cstdint>

#include "base/image.h"

namespace pleinair::compositor {

/// Returns whether a picture has the colors of a normal map: red and green around one half, blue
/// above, on average.
bool LooksLikeNormalMap(const Image<std::uint8_t>& image);

/// Converts heights to a normal map, three channels. White is higher than black by `bump`
/// hundredths of the picture's width. Wavefront's format defines no unit; with this one, textures
/// of any resolution have equal bumps. Slopes are central differences; the picture repeats.
Image<std::uint8_t> NormalMapFromHeight(const Image<std::uint8_t>& heights, float bump);

/// A picture whose green is `roughness` and whose blue is `metal`, each from its red channel. An
/// empty picture counts as white. The result has the size of the larger one; the other is sampled.
Image<std::uint8_t> CombinedRoughnessAndMetal(const Image<std::uint8_t>& roughness,
                                              const Image<std::uint8_t>& metal);

}  // namespace pleinair::compositor
