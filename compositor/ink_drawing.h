#pragma once

#include <span>

#include "base/error.h"
#include "base/vector.h"
#include "compositor/canvas.h"
#include "compositor/ink/ink_shape.h"
#include "compositor/passes/frame_daylight.h"
#include "compositor/passes/frame_uniforms.h"
#include "compositor/passes/ink_pass.h"
#include "compositor/passes/scene_shadows.h"
#include "compositor/passes/shadow_ratio_pass.h"
#include "compositor/surfaces/scene_surfaces.h"
#include "shadows/light_window.h"

namespace pleinair::compositor {

/// What a frame's ink is drawn from. Surfaces are classified, shadow maps are up to date.
struct InkScene {
  const SceneSurfaces& surfaces;
  const ShadowRatioPass& ratio;
  const FrameDaylight& light;
  const SceneShadows& shadows;
  const ShadowRatioPass::ShadowOptions& unmodelled;
};

/// Draws the ink of a scene into each frame. Needs a current OpenGL context; move-only.
class InkDrawing {
 public:
  /// As Composer::SetInk(). `surfaces` and `canvas` are told that there is ink.
  Result<void> SetShapes(std::span<const InkShape> shapes, const Mat3& marker_from_world,
                         SceneSurfaces* surfaces, Canvas* canvas);
  /// Draws what the pinhole camera sees into canvas->ink. Does nothing without ink. Errors: those
  /// of InkPass::Draw(); no memory.
  Result<void> Draw(const InkScene& scene, const shadows::View& view, const FrameUniforms& frame,
                    Canvas* canvas);
  /// Lets go of programs, for other shadow maps.
  void ClearPrograms() { pass_.ClearPrograms(); }

 private:
  InkPass pass_;
};

}  // namespace pleinair::compositor
