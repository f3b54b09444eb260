#pragma once

#include <cstdint>
#include <optional>

#include "base/error.h"
#include "base/image.h"
#include "compositor/models/model.h"
#include "scene/leaf_description.h"

namespace pleinair::compositor {

/// The maps of a leaf; those that are empty vary nothing. All have the same size.
struct LeafMapImages {
  Image<std::uint8_t> pigment;    ///< LeafMaps::pigment.
  Image<std::uint8_t> gloss;      ///< Its first channel.
  Image<std::uint8_t> thickness;  ///< Its first channel.
};

/// Reads the maps of a leaf and makes those that its structure image stands for. Errors (input): no
/// pictures, different sizes.
Result<LeafMapImages> ReadLeafMaps(const scene::LeafMapFiles& files);

/// ApplyLeaf() to a material of a model, with maps: the colors of every texel become textures under
/// D65. Contents are rounded to 1/63 of their largest value in the map. The alpha of an earlier
/// texture stays.
void ApplyMappedLeaf(const LeafSurface& leaf, const LeafMapImages& maps, int material,
                     Model* model);

}  // namespace pleinair::compositor
