#ifndef COMPOSITOR_LENS_DEPTH_GLSL
#define COMPOSITOR_LENS_DEPTH_GLSL
// The samples' depth.

#include "compositor/shaders/dioptres.glsl"

layout(binding = 0) uniform sampler2DMS u_sample_depth;
uniform int u_samples;  // Per pixel.

#endif
