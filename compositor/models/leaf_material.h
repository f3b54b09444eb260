#pragma once

#include <array>

#include "compositor/leaf/leaf_color.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// How a light changes a leaf's colors, as factors. The identity for other materials.
struct LeafTints {
  std::array<float, 3> base_sky{1.0F, 1.0F, 1.0F};     ///< Reflected skylight, against D65.
  std::array<float, 3> base_sun{1.0F, 1.0F, 1.0F};     ///< Reflected sunlight, against skylight.
  std::array<float, 3> through_sky{1.0F, 1.0F, 1.0F};  ///< The same for transmitted light.
  std::array<float, 3> through_sun{1.0F, 1.0F, 1.0F};
};

/// Share of light along the normal that a leaf's surface reflects into the gloss lobe. It is
/// min(gloss, 1) × (1 − t(40°, n)), with the lobe's n = 1.45. The rest enters the leaf. The share
/// is 0 for the plate model, all of whose reflectance is diffuse, as in its paper.
float SurfaceShareOf(const LeafSurface& leaf);

/// Makes a material that of a leaf: its base color and transmission are those of the inside, of
/// light that the surface admits, under D65. Textures, metal, coat and layers go; alpha stays.
void ApplyLeaf(const LeafSurface& leaf, Material* material);

/// The change of these colors in the light of sun and sky.
LeafTints LeafTintsIn(const LeafSurface& leaf, const LeafIlluminant& sun,
                      const LeafIlluminant& sky);

}  // namespace pleinair::compositor
