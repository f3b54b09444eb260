#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "compositor/models/model.h"

namespace pleinair::compositor {

/// The vertices of a mesh before ApplyNormals().
struct VertexSources {
  std::size_t mesh = 0;                 ///< Index of the mesh.
  std::vector<std::uint32_t> vertices;  ///< One per vertex of the new mesh.
  /// By vertex, whether its triangle has its own normal. The corners of such triangles follow each
  /// other.
  std::vector<std::uint8_t> flat;
};

/// Gives every vertex of the model a unit normal. A zero normal in the input means that the file
/// has none. kSmooth averages by position and weights each triangle by its angle there (Thürmer &
/// Wüthrich 1998). kFlat uses the triangle's own normal and gives it unshared corners. kFromFile
/// does the same only for triangles with a corner that lacks a normal. Triangles with coincident or
/// collinear corners are removed, and meshes without triangles.
///
/// Returns the vertices before, one entry per mesh that remains.
std::vector<VertexSources> ApplyNormals(NormalsMode mode, Model* model);

/// Replaces the normals by those of kSmooth; zero where no triangle gives any.
void SmoothNormals(Model* model);

}  // namespace pleinair::compositor
