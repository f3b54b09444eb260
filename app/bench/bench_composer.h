#pragma once

#include <memory>
#include <vector>

#include "base/camera_model.h"
#include "base/error.h"
#include "base/vector.h"
#include "compositor/composer.h"

namespace pleinair::app {

/// A composer for made scenes: an even sky and a sun in the south-west, 37° high. Errors: no OpenGL
/// 4.5 (system).
Result<std::unique_ptr<compositor::Composer>> MakeBenchComposer(
    const CameraModel& camera, const std::vector<compositor::PlacedModel>& models,
    const compositor::Antialiasing& antialiasing);

/// Exposure at which white ground in sun and sky has a linear value of 0.9.
LinearRgb BenchExposure();

/// A camera in the middle of an image of this size, without distortion.
CameraModel BenchCamera(int width, int height);

}  // namespace pleinair::app
