#pragma once

#include <cstdint>

#include "base/image.h"

namespace pleinair::compositor {

/// How a leaf's properties vary over it; 8 bits, linear.
struct LeafMaps {
  /// Red, green and blue scale chlorophyll, carotenoids and brown pigments; 255 is 1.
  Image<std::uint8_t> pigment;
  Image<std::uint8_t> gloss;      ///< One channel; 255 is 1.
  Image<std::uint8_t> thickness;  ///< One channel; 128 is 1. Scales all contents.
};

inline constexpr double kThicknessCodeOfOne = 128.0;

/// The maps that a structure image makes (Miao et al. 2016, "Appearance texture"): red is the share
/// of the main vein, green of secondary veins, blue of mesophyll. Mesophyll has the most
/// chlorophyll; veins are yellower and browner, glossier and thicker. The paper gives this order;
/// the values are ours. Shares are divided by their sum; black counts as mesophyll. `structure`
/// has at least three channels.
LeafMaps MapsOfStructure(ImageView<const std::uint8_t> structure);

}  // namespace pleinair::compositor
