// Narrow penumbrae that end where their casters do, and not at whole texels.
#ifndef PLEINAIR_SHADOW_CASTER_EDGES
#define PLEINAIR_SHADOW_CASTER_EDGES
#include "shadows/shaders/shadow_formulae.glsl"
#include "shadows/shaders/shadow_lookup.glsl"

// Lines at which casters end in the texels of the finest maps (shadows/edge_map.h).
layout(binding = 24) uniform usampler2D shadow_edges[SHADOW_SETS];

// Half-widths of the narrowest and the widest box over parts of texels, texels.
const float kNarrowestBox = 0.02, kWidestBox = 3.5;

// 1 if a texel occludes the receiver's plane, else 0.
float ShadowTexelBlocks(int set, int slice, vec4 size, ShadowReceiver r, ivec2 texel) {
  texel = clamp(texel, ivec2(0), ivec2(size.z) - 1);
  float depth = texelFetch(shadow_maps[2 * set], ivec3(texel, slice), 0).r;
  float plane = r.depth - r.bias + dot(r.slope, vec2(texel) + 0.5 - r.texel);
  return depth < 1.0 && depth * size.w < plane ? 1.0 : 0.0;
}

// Share of a texel's part of the box that is blocked. The texel's lines (EdgeLine) divide it. The
// part with its centre is as its depth says, and that beyond a line is as the next texel there.
// `low`, `high`: of the part, from the texel's centre.
float ShadowDivided(int set, int slice, vec4 size, ShadowReceiver r, ivec2 texel, uvec2 lines,
                    vec2 low, vec2 high) {
  vec2 half_sides = 0.5 * (high - low), centre = 0.5 * (low + high);
  float own = ShadowTexelBlocks(set, slice, size, r, texel);
  vec3 line[2];
  vec2 beyond, next;
  for (int i = 0; i < 2; ++i) {
    line[i] = EdgeLine(lines[i]);
    vec2 steps = floor(line[i].xy / max(abs(line[i].x), abs(line[i].y)) + 0.5);
    next[i] = ShadowTexelBlocks(set, slice, size, r, texel + ivec2(steps));
    line[i].z -= dot(line[i].xy, centre);
    beyond[i] = lines[i] != 0u ? ShareBeyond(half_sides, line[i]) : 0.0;
  }
  beyond -= 0.5 * ShareBeyondBoth(beyond.x, beyond.y, dot(line[0].xy, line[1].xy));
  return own + dot(beyond, next - own);
}

// Visibility averaged over a box of ±k texels around the receiver, whose texels are divided by the
// lines in them. `otherwise`: where it is not wanted, in coarser maps, where the box is too wide,
// or where no caster ends. One texel after another: Mesa's software renderer runs a loop's body at least once.
float ShadowAtEdges(int set, int slice, vec4 size, ShadowReceiver r, vec2 k, bool wanted,
                    float otherwise) {
  wanted = wanted && slice == 0 && max(k.x, k.y) <= kWidestBox;
  k = clamp(k, kNarrowestBox, kWidestBox);
  // Lines beside a narrow box tell that its texels need not be blurred.
  vec2 reach = max(k, 1.0);
  ivec2 first = ivec2(floor(r.texel - reach)), last = ivec2(floor(r.texel + reach));
  if (!wanted) last = first;
  ivec2 texel = first;
  float blocked = 0.0;
  uint found = 0u;
  do {
    uvec2 lines = texelFetch(shadow_edges[set], texel, 0).rg;
    vec2 from_centre = r.texel - vec2(texel) - 0.5;
    vec2 low = clamp(from_centre - k, -0.5, 0.5), high = clamp(from_centre + k, -0.5, 0.5);
    blocked += (high.x - low.x) * (high.y - low.y) *
               ShadowDivided(set, slice, size, r, texel, lines, low, high);
    found |= lines.x;
    bool ends = texel.x == last.x;
    texel = ivec2(ends ? first.x : texel.x + 1, ends ? texel.y + 1 : texel.y);
  } while (texel.y <= last.y);
  return wanted && found != 0u ? max(1.0 - blocked / (4.0 * k.x * k.y), 0.0) : otherwise;
}

#endif
