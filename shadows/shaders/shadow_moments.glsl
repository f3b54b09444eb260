// Methods that compute visibility from blurred moments of depth.
#ifndef PLEINAIR_SHADOW_MOMENTS
#define PLEINAIR_SHADOW_MOMENTS
#include "shadows/shaders/shadow_formulae.glsl"
#include "shadows/shaders/shadow_lookup.glsl"

float ShadowFromMoments(int set, int slice, vec4 size, ShadowReceiver r, float min_sigma) {
  vec2 map_texels = vec2(textureSize(shadow_maps[2 * set], 0).xy);
  // Do not filter beyond the slice's own texels: a map of another size may lie there.
  vec2 texel = clamp(r.texel, vec2(0.5), vec2(size.z - 0.5));
  vec4 moments = textureLod(shadow_maps[2 * set], vec3(texel / map_texels, float(slice)), 0.0);
  float sigma = min_sigma + r.rise / size.w;
  float depth = (r.depth - r.bias) / size.w - 0.5;
#ifdef SHADOW_METHOD_EXPONENTIAL
  vec2 warped = ShadowWarp(depth);
  // A standard deviation of depth, mapped through the warp: its derivative is c times the warp
  // itself.
  vec2 minimum = 2.0 * kShadowWarp * warped * sigma;
  vec2 mean = moments.xz;
  vec2 variance = max(moments.yw - mean * mean, minimum * minimum);
  return min(VarianceVisibility(warped.x, mean.x, variance.x),
             VarianceVisibility(warped.y, mean.y, variance.y));
#else
  float variance = max(moments.y - moments.x * moments.x, sigma * sigma);
#ifdef SHADOW_METHOD_GAUSSIAN
  return GaussianVisibility(depth, moments.x, variance);
#else
  return ReduceBleeding(VarianceVisibility(depth, moments.x, variance), SHADOW_METHOD_VARIANCE);
#endif
#endif
}

#endif
