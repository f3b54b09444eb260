#pragma once

#include <memory>

#include "base/error.h"
#include "base/image.h"
#include "compositor/models/model.h"

namespace pleinair::app {

/// Draws a contact sheet of a model: views from the front, the right, the back, and above. The
/// ground is grey. The sky is clear, with the sun at the left of the front. Each view has a scale
/// bar. It has the outline of a person of 1.75 m where that fits the view. The model is loaded
/// upright, z up. Errors: no OpenGL, no memory.
Result<RgbImage> ContactSheet(const std::shared_ptr<const compositor::Model>& model);

}  // namespace pleinair::app
