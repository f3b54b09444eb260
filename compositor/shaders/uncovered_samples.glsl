#ifndef COMPOSITOR_UNCOVERED_SAMPLES_GLSL
#define COMPOSITOR_UNCOVERED_SAMPLES_GLSL
// From the samples of a pixel that show affected real surfaces to the shadow-catcher ratio of the
// pixel. The other samples show unaffected surfaces, or objects; objects count as 1. BLENDED: panes
// cover two samples whatever their alpha, so that a sample beside them has another weight.

uniform float u_samples;  // Per pixel.
#ifdef BLENDED
layout(binding = 18) uniform sampler2D u_sample_weights;  // From virtual_object.frag.
#endif

float SampleWeight() {
#ifdef BLENDED
  return texelFetch(u_sample_weights, ivec2(gl_FragCoord.xy), 0).r;
#else
  return 1.0 / u_samples;
#endif
}

// `ratio`: sum over `samples` affected ones.
vec3 RatioOfPixel(vec3 ratio, float samples) {
#ifdef BLENDED
  return 1.0 + SampleWeight() * (ratio - samples);
#else
  return (ratio + (u_samples - samples)) / u_samples;
#endif
}

#endif
