#pragma once

#include <array>
#include <optional>

#include "base/error.h"
#include "compositor/passes/surface_programs.h"
#include "compositor/surfaces/scene_materials.h"
#include "shadows/shadow_maps.h"

namespace pleinair::compositor {

/// The programs that frames of a scene need. Each kind is created on first use. Needs a current
/// OpenGL context; move-only.
class FramePrograms {
 public:
  /// What differs from frame to frame.
  struct Needs {
    bool fades = false;     ///< Two steps of the sun fade into one another.
    bool airlight = false;  ///< Airlight is noticeable.
  };

  /// Programs for shadow maps and materials. Errors as SurfacePrograms::Create().
  Result<const SurfacePrograms*> For(const shadows::ShadowMapOptions& maps,
                                     const SceneMaterials& materials, Needs needs);
  /// Lets go of all, for other shadow maps or materials.
  void Clear() { made_ = {}; }

 private:
  std::array<std::array<std::optional<SurfacePrograms>, 2>, 2> made_;  // By fades, airlight.
};

}  // namespace pleinair::compositor
