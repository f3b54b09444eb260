#pragma once

#include <optional>
#include <vector>

#include "base/utc_time.h"
#include "compositor/light/lit_mesh.h"

namespace pleinair::session {

/// Fades the indirect illumination from one baked light into the next, so that a better light of
/// the same scene does not appear with a jump.
class LightFade {
 public:
  /// Begins a fade from the light in use at the next call of At(). There is none where the surfaces
  /// differ (LitMesh::geometry).
  void Begin(const std::vector<compositor::LitMesh>& in_use,
             const std::vector<compositor::LitMesh>& next);

  /// The light of a frame at `time`: a linear mix with `next` over 0.4 s of frame time. Nothing
  /// where no fade goes on; `next` is then to be used as it is, for the first time where `on()`.
  std::optional<std::vector<compositor::LitMesh>> At(UtcTime time,
                                                     const std::vector<compositor::LitMesh>& next);

  /// True until At() has returned nothing.
  bool on() const { return !from_.empty(); }

 private:
  std::vector<compositor::LitMesh> from_;   // Empty: no fade goes on.
  std::vector<compositor::LitMesh> mixed_;  // Of the last frame.
  std::optional<UtcTime> start_;
};

}  // namespace pleinair::session
