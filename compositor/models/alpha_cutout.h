#pragma once

#include <cstddef>

#include "compositor/models/model.h"

namespace pleinair::compositor {

/// Takes out of a model's surfaces what their textures' alpha cuts out (Material::Alpha::kCutout),
/// so that shadows and the light among surfaces have the holes that are drawn, and of glass
/// (kBlended) what hides less than half of what lies behind. Triangles on a
/// hole's edge are divided, the largest on the texture first, down to a 64th of their side or two
/// texels; what is left of them covers all that is drawn near by. What is drawn stays whole
/// (MeshRole::kRenderOnly): from so far that pixels are coarser than texels it is the mean of the
/// texture's alpha, which has the holes already. Cut meshes grow by no more than `max_added`
/// triangles altogether. Meshes that are nothing but holes go; glass stays to be drawn.
void ApplyAlphaCutout(Model* model, std::size_t max_added = 100'000);

}  // namespace pleinair::compositor
