#pragma once

#include "compositor/models/model.h"

namespace pleinair::compositor {

/// Gives every vertex of the model a unit normal. A normal of zero means that the file has none.
/// kFlat and, where a corner lacks a normal, kFromFile: the triangle's own, corners no longer
/// shared with its neighbours. kSmooth: by position, each triangle weighted by its angle there
/// (Thürmer & Wüthrich 1998). Triangles whose corners coincide or lie in line are removed.
void ApplyNormals(NormalsMode mode, Model* model);

}  // namespace pleinair::compositor
