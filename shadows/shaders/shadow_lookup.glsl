// Map access of the methods of shadow_visibility.glsl.
#ifndef PLEINAIR_SHADOW_LOOKUP
#define PLEINAIR_SHADOW_LOOKUP

#ifndef SHADOW_SETS
#define SHADOW_SETS 1
#endif
#define SHADOW_MAX_SLICES 4
#ifndef SHADOW_PARTITIONS
#define SHADOW_PARTITIONS SHADOW_MAX_SLICES
#endif

// Mirrors ShadowSliceUniforms in shadows/shadow_uniforms.h.
struct ShadowSlice {
  vec4 u_from_marker;      // Texel coordinates: dot(xyz, position) + w.
  vec4 v_from_marker;
  vec4 depth_from_marker;  // Metres from the near plane, away from the sun.
  vec4 size;  // Texel in metres along u and v, texels per side, depth range in metres.
};

layout(std140, binding = 8) uniform ShadowBlock {
  ShadowSlice slices[SHADOW_MAX_SLICES];
  vec4 light_u;  // Axes of light space, marker coordinates; w: weight in a cross-fade.
  vec4 light_v;
  vec4 to_sun;   // w: tangent of the disc's angular radius.
  // Number of slices, bias in metres, minimum standard deviation relative to the depth range, blend
  // band as a share of a side.
  vec4 settings;
} shadow_sets[SHADOW_SETS];

// Two per set: depth (or moments), bounds of depth.
layout(binding = 8) uniform sampler2DArray shadow_maps[2 * SHADOW_SETS];

struct ShadowReceiver {
  vec2 texel;   // Position in the slice's map, texels.
  vec2 slope;   // Depth of the receiver's plane per texel, metres.
  float depth;  // Metres.
  float bias;   // Metres.
  float rise;  // Rise of its own surface from a texel to the next, metres, up to the limit of the
               // tolerance.
  vec2 step_x;  // Footprint of one image pixel, texels: the visibility is averaged over it.
  vec2 step_y;
};

// 2×2 texels relative to the receiver, in the order of textureGather: (0,1), (1,1), (1,0), (0,0)
// from the lower left.
struct ShadowQuad {
  vec4 height;  // Metres towards the sun from the receiver's point.
  vec4 excess;  // Metres towards the sun from the receiver's plane at the texel, less the bias.
};

ShadowQuad ShadowFetch(int set, int slice, vec4 size, ShadowReceiver r, vec2 corner) {
  vec2 map_texels = vec2(textureSize(shadow_maps[2 * set], 0).xy);
  vec4 depth =
      textureGather(shadow_maps[2 * set], vec3((corner + 1.0) / map_texels, float(slice)), 0);
  // Where nothing was drawn nothing occludes, at any depth of the receiver.
  depth = depth * size.w + 1e6 * vec4(greaterThanEqual(depth, vec4(1.0)));
  vec2 offset = corner + 0.5 - r.texel;
  float plane = dot(r.slope, offset) - r.bias;
  ShadowQuad quad;
  quad.height = r.depth - depth;
  quad.excess = quad.height + plane + vec4(r.slope.y, r.slope.x + r.slope.y, r.slope.x, 0.0);
  return quad;
}

vec4 ShadowBlocks(ShadowQuad quad, float min_height) {
  return vec4(greaterThan(quad.excess, vec4(0.0))) *
         vec4(greaterThan(quad.height, vec4(min_height)));
}

// Bilinear interpolation of 2×2 texels in a quad's order; f: from the lower left one's centre to
// the others'.
float ShadowBilinear(vec4 quad, vec2 f) {
  vec2 across = mix(quad.wx, quad.zy, f.x);
  return mix(across.x, across.y, f.y);
}

// Bilinearly weighted share of the 2×2 texels around `texel` that do not occlude.
float ShadowTap(int set, int slice, vec4 size, ShadowReceiver r, vec2 texel, float min_height) {
  vec2 corner = floor(texel - 0.5);
  vec4 blocks = ShadowBlocks(ShadowFetch(set, slice, size, r, corner), min_height);
  return 1.0 - ShadowBilinear(blocks, texel - 0.5 - corner);
}

#endif
