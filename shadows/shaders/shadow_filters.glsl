// Reference methods that compare depths: one comparison, a box of them, or a search and a filter.
// All compare with the receiver's plane, texel by texel (Isidoro 2006), so that they differ in the
// kernel and not in the bias.
#ifndef PLEINAIR_SHADOW_FILTERS
#define PLEINAIR_SHADOW_FILTERS
#include "shadows/shaders/shadow_formulae.glsl"
#include "shadows/shaders/shadow_lookup.glsl"

// Williams 1978: the nearest texel.
float ShadowNearest(int set, int slice, vec4 size, ShadowReceiver r) {
  ivec2 texel = clamp(ivec2(floor(r.texel)), ivec2(0), ivec2(int(size.z) - 1));
  float depth = texelFetch(shadow_maps[2 * set], ivec3(texel, slice), 0).r;
  float plane = dot(r.slope, vec2(texel) + 0.5 - r.texel) - r.bias;
  return depth < 1.0 && r.depth - depth * size.w + plane > 0.0 ? 0.0 : 1.0;
}

// Mean of side × side bilinear comparisons (side odd), gathered four texels at a time. Reeves et
// al. 1987; the weights are those of a box of `side` texels around the point.
float ShadowBox(int set, int slice, vec4 size, ShadowReceiver r, int side) {
  vec2 corner = floor(r.texel - 0.5);
  vec2 f = r.texel - 0.5 - corner;
  corner -= float((side - 1) / 2);
  float blocked = 0.0;
  for (int y = 0; y <= side; y += 2) {
    float low = y == 0 ? 1.0 - f.y : 1.0, high = y + 1 == side ? f.y : 1.0;
    for (int x = 0; x <= side; x += 2) {
      ShadowQuad quad = ShadowFetch(set, slice, size, r, corner + vec2(x, y));
      vec4 blocks = vec4(greaterThan(quad.excess, vec4(0.0)));
      float left = x == 0 ? 1.0 - f.x : 1.0, right = x + 1 == side ? f.x : 1.0;
      blocked += dot(blocks, vec4(left * high, right * high, right * low, left * low));
    }
  }
  return max(1.0 - blocked / float(side * side), 0.0);
}

// Percentage-closer soft shadows as published (Fernando 2005): a search over the radius that the
// near plane's distance implies, then a filter whose width follows from the mean blocker depth.
float ShadowSoftBox(int set, int slice, vec4 size, ShadowReceiver r, float tan_radius) {
  const int kSearch = 16, kFilter = 32;
  float search_m = max(r.depth, 0.0) * tan_radius;
  float height_sum = 0.0, blockers = 0.0;
  for (int i = 0; i < kSearch; ++i) {
    vec2 texel = r.texel + search_m * VogelDisc(i, kSearch) / size.xy;
    ShadowQuad quad = ShadowFetch(set, slice, size, r, floor(texel - 0.5));
    vec4 blocks = vec4(greaterThan(quad.excess, vec4(0.0)));
    height_sum += dot(blocks, quad.height);
    blockers += dot(blocks, vec4(1.0));
  }
  float filter_m = height_sum / max(blockers, 1.0) * tan_radius;
  float visible = 0.0;
  int count = blockers > 0.0 ? kFilter : 0;
  for (int i = 0; i < count; ++i) {
    visible += ShadowTap(set, slice, size, r, r.texel + filter_m * VogelDisc(i, kFilter) / size.xy,
                         -1e30);
  }
  return blockers > 0.0 ? visible / float(kFilter) : 1.0;
}

#endif
