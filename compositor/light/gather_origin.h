#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// How far rays start above a surface, metres.
inline constexpr double kRayOffset_m = 3e-4;

/// A point of a surface, marker coordinates.
struct SurfacePoint {
  Vec3 position, normal;
  Vec3 lift;  ///< As SurfaceMesh::lifts.

  SurfacePoint OtherSide() const { return {position, -normal, lift}; }
  /// The lift if it points outwards, else zero.
  Vec3 OutwardLift() const { return Dot(lift, normal) > 0.0 ? lift : Vec3{}; }
};

SurfacePoint SurfacePointAt(const SurfaceMesh& mesh, std::uint32_t vertex);

/// SurfacePoint::OutwardLift() of all vertices; empty if the mesh has no lifts.
std::vector<std::array<float, 3>> OutwardLifts(const SurfaceMesh& mesh);

/// The mean centre of the triangles around each vertex.
std::vector<Vec3> CentresAround(const SurfaceMesh& mesh);

/// Where the rays of a point start: slightly above the surface, or above the curved surface that
/// its normals describe where that is higher (Hanika 2021, "Hacking the shadow terminator").
///
/// Corners of bodies on the ground lie in the ground's plane, where a ray may start on either side.
/// Origins are therefore pulled towards `centre`, the mean centre of the triangles around the
/// point, but not below the point's tangent plane: on a coarse convex body that would be inside.
Vec3 GatherOrigin(const SurfacePoint& point, Vec3 centre);

}  // namespace pleinair::compositor
