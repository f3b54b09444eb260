#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/composer.h"
#include "compositor/ink/ink_shape.h"
#include "compositor/models/placed_model.h"
#include "scene/scene_description.h"

namespace pleinair::session {

/// Returns the ink that lies on phantoms, for Composer::SetInk(). `phantoms`: marker coordinates,
/// in the order of the scene. `marker`: with its heading.
using InkSource = std::function<Result<std::vector<compositor::InkShape>>(
    std::span<const compositor::PlacedModel> phantoms, const scene::MarkerDescription& marker)>;

/// The ink on the ground of a scene. It is laid anew when the marker's heading changes, since
/// phantoms turn with the marker and the map does not.
class GroundInk {
 public:
  void SetSource(InkSource source);
  bool has_source() const { return source_ != nullptr; }
  /// Lays the ink where it has to lie. Errors: those of the source and of Composer::SetInk().
  Result<void> Update(std::span<const compositor::PlacedModel> phantoms,
                      const scene::MarkerDescription& marker, compositor::Composer* composer);

 private:
  InkSource source_;
  std::optional<Mat3> laid_at_;  // The marker_from_world of the ink in use.
};

}  // namespace pleinair::session
