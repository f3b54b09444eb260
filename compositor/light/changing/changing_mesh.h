#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/models/animation/model_animation.h"
#include "compositor/models/placed_model.h"
#include "compositor/models/surface_orientation.h"

namespace pleinair::compositor {

/// The surfaces of a placed model that changes its shape, marker coordinates. Its triangles are
/// those of the model, split once into pieces that are fine enough for light at vertices. What is
/// inside and what is a front stays as in the shape that it was made with.
class ChangingMesh {
 public:
  ChangingMesh(const PlacedModel& placed, int placed_model);

  int placed_model() const { return placed_model_; }
  /// Takes the shape of the model's meshes, at the current place.
  void SetShape(std::span<const MeshShape> shape);
  /// Moves the model relative to where it was placed: x' = linear x + translation. Applies from the
  /// next SetShape() on.
  void Move(const Mat3& linear, Vec3 translation_m);

  /// Returns whether a shape has other triangles than the surfaces.
  static bool HasTriangles(std::span<const MeshShape> shape);
  /// The same body with the triangles of `shape`, and without its texture coordinates. `shape`: one
  /// entry per mesh of the model.
  ChangingMesh WithTriangles(std::span<const MeshShape> shape) const;

  /// The surfaces in their current shape. Both sides of an open one are one surface.
  std::span<const SurfaceMesh> surfaces() const { return surfaces_; }
  /// What to draw, without light: one mesh per surface, and a second for the back of an open one.
  std::vector<LitMesh> DrawnMeshes() const;
  /// How vertices have moved since the last CopyShape() into the same meshes.
  struct Movement {
    float farthest_m = 0.0F;  ///< Max. change of a coordinate of a vertex.
    bool any = false;         ///< A position or normal has changed.
  };
  /// Copies the current positions and normals into the meshes of DrawnMeshes().
  Movement CopyShape(std::span<LitMesh> drawn) const;

 private:
  struct Source {
    std::size_t mesh = 0;
    std::array<float, 3> reflectance{}, transmittance{};
    std::vector<std::uint32_t> vertices;  // Index in the mesh, for each vertex before the split.
    std::vector<bool> turned;             // By vertex: the normal is opposite to the mesh's.
    std::vector<std::array<std::uint32_t, 2>> parents;  // Ends of the edges that were split.
  };
  static void Split(double max_edge_m, SurfaceMesh* surface, Source* source);

  int placed_model_;
  PlacedModel placed_;  // With the triangles of the surfaces.
  Mat3 linear_;
  Vec3 translation_m_;
  std::vector<SurfaceMesh> surfaces_;
  std::vector<Source> sources_;  // One per surface.
};

}  // namespace pleinair::compositor
