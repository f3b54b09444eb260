#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/models/model_frame.h"
#include "compositor/surfaces/mesh_outline.h"
#include "compositor/surfaces/surface_buffers.h"
#include "shadows/shadow_maps.h"

namespace pleinair::compositor {

/// Current placement of a scene's surfaces, whose models may have moved since they were lit. It has
/// their bounds and shadow casters. Marker coordinates, metres.
class SurfacePlacement {
 public:
  /// Removes all surfaces. Shadow maps treat surfaces added later as new ones.
  void Clear();
  /// Adds the next surface, in order. `outline`: of the mesh, as OutlineOf().
  void Add(const LitMesh& mesh, std::span<const OutlineEdge> outline);
  /// Extends the bounds of the surface added last to those of all its shapes.
  void IncludeShapes(const ModelBounds& shapes);
  /// Gives a surface another shape; applies from the next Reset(), Move() or Refresh() on. Its
  /// bounds only grow, so that shadow maps which are fitted to them seldom change. The mesh must
  /// outlive the shape.
  void SetShape(std::size_t surface, const LitMesh& mesh);
  /// Follows the surfaces' shapes.
  void Refresh(std::span<const SurfaceBuffers> surfaces) { Place(surfaces); }
  /// Resets all `models` placed models to where they were lit. `surfaces`: the added surfaces;
  /// casters() refers to them.
  void Reset(std::size_t models, std::span<const SurfaceBuffers> surfaces);
  /// As Composer::MoveModel().
  void Move(int placed_model, const Mat3& linear, Vec3 translation_m,
            std::span<const SurfaceBuffers> surfaces);

  /// Transform to marker coordinates from where the model was lit.
  const glm::dmat4& MovedBy(int placed_model) const {
    return moved_[static_cast<std::size_t>(placed_model)];
  }
  /// Casters for shadow maps: of all surfaces, and of the phantoms alone.
  std::span<const shadows::ShadowCaster> casters() const { return casters_; }
  std::span<const shadows::ShadowCaster> phantom_casters() const { return phantom_casters_; }
  /// Bounds of the virtual objects that cast shadows; of all, if none does.
  const shadows::Box& object_bounds() const { return object_bounds_; }
  const shadows::Box& bounds() const { return bounds_; }

 private:
  /// Computes casters and bounds at the models' current places.
  void Place(std::span<const SurfaceBuffers> surfaces);

  /// Extent and shape of a surface.
  struct Shape {
    shadows::Box bounds;         // Where it was lit.
    std::uint64_t revision = 0;  // As shadows::ShadowCaster.
    bool changes = false;
    shadows::TriangleSpan triangles;  // After SetShape().
    std::vector<shadows::CasterEdge> edges;
  };

  std::vector<Shape> shapes_;      // One per surface.
  std::vector<glm::dmat4> moved_;  // One per placed model.
  std::vector<shadows::ShadowCaster> casters_, phantom_casters_;
  shadows::Box object_bounds_, bounds_;
  std::uint64_t revision_ = 0;  // Counts new surfaces and shapes, which shadow maps follow.
};

}  // namespace pleinair::compositor
