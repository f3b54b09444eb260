#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/utc_time.h"
#include "compositor/light/lit_mesh.h"

namespace pleinair::session {

/// Fades the indirect illumination from one baked light into the next. A better light of the same
/// scene thus appears without a jump.
class LightFade {
 public:
  /// Begins a fade from the light in use to `next` at the next call of At(). Lights of different
  /// surfaces (LitMesh::geometry) do not fade.
  void Begin(const std::vector<compositor::LitMesh>& in_use,
             const std::vector<compositor::LitMesh>& next);

  /// Returns the light of a frame at `time`: a linear mix with `next`, as in Begin(), over 0.4 s of
  /// frame time. It is valid until the next call. Null: no fade goes on, and `next` is used as it
  /// is. A fade has just ended if on() was true before the call.
  const std::vector<compositor::LitMesh>* At(UtcTime time,
                                             const std::vector<compositor::LitMesh>& next);

  /// True until At() has returned null.
  bool on() const { return !from_.empty(); }

 private:
  using VertexLight = std::vector<std::array<float, 3>>;
  struct MeshLight {
    VertexLight with, without, reflected_with, reflected_without;
  };

  void End();

  std::vector<MeshLight> from_;             // Empty: no fade goes on.
  std::vector<compositor::LitMesh> mixed_;  // Light of the last At(); `next` until then.
  std::optional<UtcTime> start_;
};

}  // namespace pleinair::session
