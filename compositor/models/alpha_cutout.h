#pragma once

#include <cstddef>

#include "compositor/models/model.h"

namespace pleinair::compositor {

/// Cuts the holes of alpha cut-outs (Material::Alpha::kCutout) out of a model's surfaces. Shadows
/// and indirect illumination then have the holes that are drawn. From glass (kBlended) it removes
/// the parts that hide less than half of the background.
///
/// Triangles on a hole's edge are divided, the largest on the texture first, down to a 64th of
/// their side or two texels. The remaining triangles cover everything that is drawn nearby. Cut
/// meshes grow by at most `max_added` triangles in total.
///
/// The rendered mesh stays whole (MeshRole::kRenderOnly), because the texture's alpha draws the
/// holes. Where pixels are coarser than texels, the mean of the texture's alpha applies. Meshes
/// that are nothing but holes are removed; glass remains and is drawn.
void ApplyAlphaCutout(Model* model, std::size_t max_added = 100'000);

}  // namespace pleinair::compositor
