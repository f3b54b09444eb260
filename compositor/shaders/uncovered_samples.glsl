#ifndef COMPOSITOR_UNCOVERED_SAMPLES_GLSL
#define COMPOSITOR_UNCOVERED_SAMPLES_GLSL
// From the affected real surfaces of a pixel, weighted as in piece_weights.glsl, to the
// shadow-catcher ratio of the pixel. The rest shows unaffected surfaces, or objects; objects count
// as 1. BLENDED: panes cover two samples whatever their alpha, so that what is beside them has
// another weight.

#include "compositor/shaders/piece_weights.glsl"

#ifdef BLENDED
layout(binding = 18) uniform sampler2D u_sample_weights;  // From virtual_object.frag.
#endif

// Share of the pixel of each unit of weight.
float WeightOfUncovered() {
#ifdef BLENDED
  return texelFetch(u_sample_weights, ivec2(gl_FragCoord.xy), 0).r;
#else
  return 1.0 / kWeightOfPixel;
#endif
}

// `ratio`: sum over affected surfaces, of the weight `affected` together.
vec3 RatioOfPixel(vec3 ratio, float affected) {
#ifdef BLENDED
  return 1.0 + WeightOfUncovered() * (ratio - affected);
#else
  return (ratio + (kWeightOfPixel - affected)) / kWeightOfPixel;
#endif
}

#endif
