// Ours: percentage-closer soft shadows with the sun's own geometry.
#ifndef PLEINAIR_SHADOW_SUN_DISC
#define PLEINAIR_SHADOW_SUN_DISC
#include "shadows/shaders/shadow_formulae.glsl"
#include "shadows/shaders/shadow_lookup.glsl"

#ifndef SHADOW_SEARCH_SAMPLES
#define SHADOW_SEARCH_SAMPLES 24
#endif
#ifndef SHADOW_FILTER_SAMPLES
#define SHADOW_FILTER_SAMPLES 48
#endif

// Point i of a sequence spread evenly over the pixel's footprint, texels from its middle. Roberts
// 2018, "The unreasonable effectiveness of quasirandom sequences": R2, from the plastic number.
vec2 ShadowFootprint(ShadowReceiver r, int i) {
  vec2 in_pixel = fract(0.5 + float(i + 1) * vec2(0.7548776662, 0.5698402910)) - 0.5;
  return in_pixel.x * r.step_x + in_pixel.y * r.step_y;
}

// Nearest and farthest depth in a block of the pyramid that covers `reach` texels around, and the
// block's farthest corner from the receiver in texels (z).
vec3 ShadowBounds(int set, int slice, vec4 size, vec2 texel, float reach) {
  // Level 0 of the pyramid bounds 2×2 texels; a block is 2×2 of the level's texels.
  int level = clamp(int(ceil(log2(max(reach, 1.0)))), 0, int(size.z) > 2 ? findMSB(int(size.z)) - 2 : 0);
  float side = exp2(float(level + 1));
  ivec2 first = ivec2(floor((texel - reach) / side));
  ivec2 last = ivec2(floor(size.z / side)) - 1;
  vec2 bounds = vec2(1e30, -1e30);
  for (int i = 0; i < 4; ++i) {
    ivec2 at = clamp(first + ivec2(i & 1, i >> 1), ivec2(0), last);
    vec2 value = texelFetch(shadow_maps[2 * set + 1], ivec3(at, slice), level).rg;
    bounds = vec2(min(bounds.x, value.x), max(bounds.y, value.y));
  }
  vec2 low = vec2(first) * side - texel;
  vec2 far = max(abs(low), abs(low + 2.0 * side));
  return vec3(bounds * size.w, length(far));
}

// Visibility of the sun's disc by percentage-closer soft shadows (Fernando 2005) with the sun's own
// geometry: a blocker h metres away shades a disc of h tan 0.2665° around it.
// Deviations: (1) the search looks only as far as the highest blocker nearby can matter, found
// in a pyramid of depth bounds, so that most pixels need no search at all; (2) depths are compared
// with the receiver's plane, texel by texel, so a lit plane needs no bias to speak of; (3) blockers
// too low for any ray of the disc at their distance are left out (the foot of a sunlit wall).
float ShadowDiscVisibility(int set, int slice, vec4 size, ShadowReceiver r, float tan_radius) {
  float texel_m = max(size.x, size.y);
  float slope_texel = length(r.slope);
  float footprint = 0.5 * (length(r.step_x) + length(r.step_y));
  // Bounds: start with what anything up to the near plane could do, then tighten.
  float reach = r.depth * tan_radius / min(size.x, size.y) + footprint + 1.0;
  vec3 bounds = ShadowBounds(set, slice, size, r.texel, reach);
  reach = max(r.depth - bounds.x, 0.0) * tan_radius / min(size.x, size.y) + footprint + 1.0;
  bounds = ShadowBounds(set, slice, size, r.texel, reach);
  float highest_m = max(r.depth - bounds.x, 0.0);
  float search_m = highest_m * tan_radius;

  // The bilinear tap is a tent of variance 1/6 texel² a axis; a disc of radius ρ has ρ²/4: below
  // that the tap alone is soft enough.
  float tap_radius2_m = (2.0 / 3.0) * texel_m * texel_m;
  bool umbra = bounds.y < r.depth - slope_texel * bounds.z - r.bias;
  // Nothing within reach rises above the receiver's plane.
  bool lit = highest_m < slope_texel * bounds.z + r.bias;
  bool soft = search_m * search_m > tap_radius2_m || (footprint > 1.0 && !lit);
  soft = soft && !umbra;

  // Mean height of the blockers that the disc's rays can meet. Loops with a count of 0 instead of
  // branches: Mesa's software renderer runs both sides of an `if`, but leaves a loop.
  float height_sum = 0.0;
  float blockers = 0.0;
  int search_count = soft ? SHADOW_SEARCH_SAMPLES : 0;
  for (int i = 0; i < search_count; ++i) {
    vec2 offset_m = search_m * VogelDisc(i, SHADOW_SEARCH_SAMPLES);
    vec2 corner = floor(r.texel + offset_m / size.xy - 0.5);
    ShadowQuad quad = ShadowFetch(set, slice, size, r, corner);
    // A ray that passes at this distance is already higher than a blocker below this.
    float least_m = max((length(offset_m) - texel_m) / tan_radius, 0.0);
    vec4 blocks = ShadowBlocks(quad, least_m);
    height_sum += dot(blocks, quad.height);
    blockers += dot(blocks, vec4(1.0));
  }
  float mean_height_m = height_sum / max(blockers, 1.0);
  float disc_m = mean_height_m * tan_radius;
  float filter_m = sqrt(max(disc_m * disc_m - tap_radius2_m, 0.0));

  float visible = 0.0;
  bool wide = filter_m > 0.0 || footprint > 1.0;
  int filter_count = soft && wide ? SHADOW_FILTER_SAMPLES : 0;
  for (int i = 0; i < filter_count; ++i) {
    vec2 offset_m = filter_m * VogelDisc(i, SHADOW_FILTER_SAMPLES);
    float least_m = max((0.5 * length(offset_m) - texel_m) / tan_radius, 0.0);
    vec2 texel = r.texel + offset_m / size.xy + ShadowFootprint(r, i);
    visible += ShadowTap(set, slice, size, r, texel, least_m);
  }
  if (filter_count > 0) return visible / float(SHADOW_FILTER_SAMPLES);
  return ShadowTap(set, slice, size, r, r.texel, -1e30);
}

#endif
