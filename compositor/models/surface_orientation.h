#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {

/// A placed piece of surface, marker coordinates. Its triangles run counter-clockwise seen from
/// the side that the normals point to.
struct SurfaceMesh {
  bool is_phantom = false;
  int placed_model = 0;
  int material = 0;
  MeshRole role = MeshRole::kAll;
  /// Closed bodies enclose a volume and are seen from outside only; the others from both sides.
  bool closed = false;
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<float, 2>> uvs;  ///< Empty, or one a position.
  std::vector<std::uint32_t> indices;
};

struct PlacedModel;

/// Places a model's meshes and makes their winding trustworthy: neighbours agree, closed bodies
/// face outwards, open surfaces as most of their area does. Normals follow the winding; equal
/// corners become one vertex; triangles without area are left out. Each mesh yields at most two
/// surfaces, what belongs to closed bodies and what does not; a body may span several meshes. What
/// is drawn with holes (MeshRole::kRenderOnly) is no closed body: they show its inside.
std::vector<SurfaceMesh> OrientedSurfaces(const PlacedModel& placed, int placed_index);

}  // namespace pleinair::compositor
