#pragma once

#include <optional>
#include <vector>

#include "base/utc_time.h"
#include "compositor/light/lit_mesh.h"

namespace pleinair::session {

/// Fades the indirect illumination from one baked light into the next. A better light of the same
/// scene thus appears without a jump.
class LightFade {
 public:
  /// Begins a fade from the light in use at the next call of At(). Lights of different surfaces
  /// (LitMesh::geometry) do not fade.
  void Begin(const std::vector<compositor::LitMesh>& in_use,
             const std::vector<compositor::LitMesh>& next);

  /// Returns the light of a frame at `time`: a linear mix with `next` over 0.4 s of frame time.
  /// Nothing: no fade goes on, and `next` is used as it is. A fade has just ended if on() was true
  /// before the call.
  std::optional<std::vector<compositor::LitMesh>> At(UtcTime time,
                                                     const std::vector<compositor::LitMesh>& next);

  /// True until At() has returned nothing.
  bool on() const { return !from_.empty(); }

 private:
  std::vector<compositor::LitMesh> from_;   // Empty: no fade goes on.
  std::vector<compositor::LitMesh> mixed_;  // Light of the last frame.
  std::optional<UtcTime> start_;
};

}  // namespace pleinair::session
