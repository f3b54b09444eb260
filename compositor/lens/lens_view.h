#pragma once

#include "base/vector.h"
#include "compositor/lens/thin_lens.h"
#include "compositor/passes/frame_uniforms.h"
#include "gl/program.h"
#include "shadows/light_window.h"

namespace pleinair::compositor {

/// The frame as seen through one place of the stop. The camera moves there, and its image is
/// sheared so that the plane in focus stays. The mean over the stop is the image of a thin lens.
/// `place`: by StopPlaces(), times the aperture's radius. `view`: that of the frame.
FrameUniforms SeenThroughPlace(const FrameUniforms& frame, const shadows::View& view,
                               const ThinLens& lens, Vec2 place_m);

/// Sets the uniforms of shaders/lens_depth.glsl.
void SetLensDepth(const gl::GlProgram& program, const shadows::View& view, int samples);

}  // namespace pleinair::compositor
