#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// A placed part of a surface, marker coordinates. Its triangles run counter-clockwise seen from
/// the side that the normals point to.
struct SurfaceMesh {
  bool is_phantom = false;
  int placed_model = 0;
  int material = 0;
  MeshRole role = MeshRole::kAll;
  /// Closed bodies enclose a volume and are visible from outside only; other surfaces from both
  /// sides.
  bool closed = false;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<float, 2>> uvs;  ///< Empty, or one per position.
  std::vector<VertexDetail> details;      ///< Empty, or one per position.
  /// From the flat triangles to the curved surface that the normals describe, at vertices that
  /// subdivision adds (compositor/light/edge_splitting.h). Empty, or one per position.
  std::vector<std::array<float, 3>> lifts;
  std::vector<std::uint32_t> indices;
};

struct PlacedModel;

/// Places a model's meshes and makes their winding consistent. Neighbours agree, closed bodies face
/// outwards, and open surfaces face as most of their area does. Normals follow the winding. Equal
/// corners become one vertex; triangles without area are removed.
///
/// Each mesh yields at most two surfaces: its part of closed bodies, and the rest. A body may span
/// several meshes. Render-only meshes with holes (MeshRole::kRenderOnly) are never closed bodies,
/// because the holes show their inside.
std::vector<SurfaceMesh> OrientedSurfaces(const PlacedModel& placed, int placed_index);

/// A surface whose vertices are those of one mesh.
struct TracedSurface {
  SurfaceMesh surface;
  std::size_t mesh = 0;                 ///< Index into the model's meshes.
  std::vector<std::uint32_t> vertices;  ///< Index in that mesh, one per vertex of the surface.
};

/// As OrientedSurfaces(), but only corners of one vertex become one. Others may part when the model
/// changes its shape.
std::vector<TracedSurface> TracedSurfaces(const PlacedModel& placed, int placed_index);

}  // namespace pleinair::compositor
