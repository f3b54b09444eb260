#pragma once

#include "app/bench/defocus_scenes.h"
#include "base/image.h"

namespace pleinair::app {

/// Traces boards through a thin lens with a round stop: the truth for methods of depth of field.
/// Nothing of the compositor is used. A ray from the place s on the stop (in diameters) through the
/// place p of the pixel meets a board with the circle of confusion c at p − c s, in pixels of the
/// pinhole image (compositor/lens/thin_lens.h). Rays: TracedRays(). Linear light, one channel.
Image<float> TraceBoards(const DefocusScene& scene, int width, int height);

/// The same through a camera that moves during the exposure: each ray starts at its own time from
/// the camera's pose then, and meets the boards' planes in closed form. `camera`: that of the
/// scene, without distortion. The scene must have a motion.
Image<float> TraceMovingCamera(const DefocusScene& scene, const CameraModel& camera);

}  // namespace pleinair::app
