#ifndef COMPOSITOR_PIECE_WEIGHTS_GLSL
#define COMPOSITOR_PIECE_WEIGHTS_GLSL
// Weights of the pieces of surface in a pixel: shares of the pixel in units of 1/64, eight bits
// each, from the lowest on.

#include "compositor/shaders/visibility_buffer_layout.glsl"

const float kWeightOfPixel = 64.0;

float WeightOf(uint weights) { return float(weights & 255u); }

// The weights of pieces that the renderer's samples show.
uint WeightsOfSamples(uvec4 seen, int samples) {
  uvec4 counts = uvec4(bitCount(seen >> kSamplesShift)) * uint(64 / samples);
  return counts.x | counts.y << 8 | counts.z << 16 | counts.w << 24;
}

#endif
