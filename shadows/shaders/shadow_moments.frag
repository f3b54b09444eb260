#version 450 core
#include "shadows/shaders/shadow_formulae.glsl"
// First two moments of depth (WARPED: of its two exponential warps), blurred along one axis by a Gaussian whose width is set in metres.
// Texels outside the slice's own window are never read (the blur must not cross slices).
layout(binding = 0) uniform sampler2DArray source;  // FROM_DEPTH: depth 0…1, otherwise moments.
uniform int slice;
uniform int resolution;
uniform ivec2 axis;
uniform float sigma_texels;
layout(location = 0) out vec4 moments;

vec4 Fetch(ivec2 texel) {
  texel = clamp(texel, ivec2(0), ivec2(resolution - 1));
  vec4 value = texelFetch(source, ivec3(texel, slice), 0);
#ifdef FROM_DEPTH
  // Centred at half the range, which preserves the precision of both moments (32-bit floats; 16
  // bits are not enough).
  float z = value.r - 0.5;
#ifdef WARPED
  vec2 warped = ShadowWarp(z);
  return vec4(warped.x, warped.x * warped.x, warped.y, warped.y * warped.y);
#else
  return vec4(z, z * z, 0.0, 0.0);
#endif
#else
  return value;
#endif
}

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  int reach = int(ceil(3.0 * sigma_texels));
  vec4 sum = Fetch(here);
  float weights = 1.0;
  for (int i = 1; i <= reach; ++i) {
    float weight = exp(-0.5 * float(i * i) / (sigma_texels * sigma_texels));
    sum += weight * (Fetch(here + i * axis) + Fetch(here - i * axis));
    weights += 2.0 * weight;
  }
  moments = sum / weights;
}
