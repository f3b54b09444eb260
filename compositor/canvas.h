#pragma once

#include "base/camera_model.h"
#include "base/error.h"
#include "compositor/composer_options.h"
#include "compositor/lens/lens_pass.h"
#include "compositor/passes/coarse_ratio.h"
#include "compositor/passes/coverage_pass.h"
#include "compositor/passes/ink_images.h"
#include "compositor/passes/place_mean.h"
#include "compositor/passes/render_camera.h"
#include "compositor/passes/render_targets.h"
#include "compositor/picture/camera_picture.h"
#include "compositor/surfaces/scene_materials.h"

namespace pleinair::compositor {

/// What a Composer draws into, for one image size. Needs a current OpenGL context; move-only.
struct Canvas {
  RenderCamera camera;
  RenderTargets targets;
  PlaceMean places;
  CoveragePass coverage;
  CoarseRatio coarse;
  InkImages ink;
  LensPass lens;
  CameraPicture picture;

  /// The ink of the current frame; null: there is none.
  const InkImages* DrawnInk() const { return ink.kept ? &ink : nullptr; }

  /// For objects of `materials`. Errors as RenderTargets::Create() and CameraPicture::Create().
  static Result<Canvas> Create(const CameraModel& camera, const ComposerOptions& options,
                               const SceneMaterials& materials);
};

}  // namespace pleinair::compositor
