#pragma once

#include "app/bench/defocus_scenes.h"
#include "base/image.h"

namespace pleinair::app {

/// Traces boards through a thin lens with a round stop: the truth for methods of depth of field.
/// Nothing of the compositor is used. A ray from the place s on the stop (in diameters) through the
/// place p of the pixel meets a board with the circle of confusion c at p − c s, in pixels of the
/// pinhole image (compositor/lens/thin_lens.h). Each of the 4,096 rays of a pixel has its own two
/// places, from a Halton sequence (J. H. Halton, Numerische Mathematik 2, 1960). Linear light, one
/// channel.
Image<float> TraceBoards(const DefocusScene& scene, int width, int height);

}  // namespace pleinair::app
