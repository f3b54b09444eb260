#pragma once

#include "compositor/models/model.h"

namespace pleinair::compositor {

/// Gives every vertex of the model a unit normal. A zero normal in the input means that the file
/// has none. kSmooth averages by position and weights each triangle by its angle there (Thürmer &
/// Wüthrich 1998). kFlat uses the triangle's own normal and gives it unshared corners. kFromFile
/// does the same only for triangles with a corner that lacks a normal. Triangles with coincident or
/// collinear corners are removed.
void ApplyNormals(NormalsMode mode, Model* model);

}  // namespace pleinair::compositor
