#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/vector.h"
#include "compositor/light/lit_mesh.h"
#include "compositor/surfaces/surface_buffers.h"
#include "shadows/shadow_maps.h"

namespace pleinair::compositor {

/// Where a scene's surfaces stand now, as their models were moved since they were lit: their bounds
/// and what shadow maps draw of them. Marker coordinates, metres.
class SurfacePlacement {
 public:
  /// Forgets all surfaces; those added from now on are others for the shadow maps.
  void Clear();
  /// The next of the surfaces, in their order.
  void Add(const LitMesh& mesh);
  /// All of `models` placed models stand where they were lit. `surfaces`: those that were added;
  /// casters() points to them.
  void Reset(std::size_t models, std::span<const SurfaceBuffers> surfaces);
  /// As Composer::MoveModel().
  void Move(int placed_model, const Mat3& linear, Vec3 translation_m,
            std::span<const SurfaceBuffers> surfaces);

  /// Marker from where the model was lit.
  const glm::dmat4& MovedBy(int placed_model) const {
    return moved_[static_cast<std::size_t>(placed_model)];
  }
  /// For shadow maps: of everything, and of the phantoms alone.
  std::span<const shadows::ShadowCaster> casters() const { return casters_; }
  std::span<const shadows::ShadowCaster> phantom_casters() const { return phantom_casters_; }
  const shadows::Box& object_bounds() const { return object_bounds_; }
  const shadows::Box& bounds() const { return bounds_; }

 private:
  /// Casters and bounds with the models where they were moved to.
  void Place(std::span<const SurfaceBuffers> surfaces);

  std::vector<shadows::Box> lit_bounds_;  // By surface, where it was lit.
  std::vector<glm::dmat4> moved_;         // By placed model.
  std::vector<shadows::ShadowCaster> casters_, phantom_casters_;
  shadows::Box object_bounds_, bounds_;
  std::uint64_t revision_ = 0;  // Of the surfaces; the shadow maps follow it.
};

}  // namespace pleinair::compositor
