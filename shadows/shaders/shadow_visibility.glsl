// Share of the sun's disc that a point sees. For fragment shaders:
//
//   #define SHADOW_SETS 2                       // how many ShadowMaps are bound; 1 by default
//   #define SHADOW_METHOD_GAUSSIAN              // or _VARIANCE; the sun's disc by default
//   #include "shadows/shaders/shadow_visibility.glsl"
//   float lit = ShadowVisibility(0, position_marker, normal_marker);
//
// Bind the maps with ShadowMaps::Bind(set). `set` must be a constant. Marker coordinates, metres.
#ifndef PLEINAIR_SHADOW_VISIBILITY
#define PLEINAIR_SHADOW_VISIBILITY
#include "shadows/shaders/shadow_formulae.glsl"

#if !defined(SHADOW_METHOD_GAUSSIAN) && !defined(SHADOW_METHOD_VARIANCE)
#define SHADOW_METHOD_SUN_DISC
#endif
#ifndef SHADOW_SETS
#define SHADOW_SETS 1
#endif
#ifndef SHADOW_SEARCH_SAMPLES
#define SHADOW_SEARCH_SAMPLES 24
#endif
#ifndef SHADOW_FILTER_SAMPLES
#define SHADOW_FILTER_SAMPLES 48
#endif
#define SHADOW_MAX_SLICES 4

// Mirrors ShadowSliceUniforms in shadows/shadow_uniforms.h.
struct ShadowSlice {
  vec4 u_from_marker;      // Texel coordinates: dot(xyz, position) + w.
  vec4 v_from_marker;
  vec4 depth_from_marker;  // Metres from the near plane, away from the sun.
  vec4 size;               // Texel in metres along u and v, texels a side, depth range in metres.
};

layout(std140, binding = 8) uniform ShadowBlock {
  ShadowSlice slices[SHADOW_MAX_SLICES];
  vec4 light_u;  // Axes of light space, marker coordinates.
  vec4 light_v;
  vec4 to_sun;   // w: tangent of the disc's angular radius.
  vec4 settings; // Number of slices, bias in metres, minimum standard deviation in metres, –.
} shadow_sets[SHADOW_SETS];

// Two a set: depth (or moments), bounds of depth.
layout(binding = 8) uniform sampler2DArray shadow_maps[2 * SHADOW_SETS];

// Normal of the flat triangle that the fragment lies on, turned to the side of `normal`. The bias
// of the visibility follows the surface: interpolated normals would make it leak or scar.
vec3 ShadowGeometricNormal(vec3 position, vec3 normal) {
  vec3 flat_normal = cross(dFdx(position), dFdy(position));
  float size = length(flat_normal);
  if (!(size > 1e-20)) return normal;
  return (dot(flat_normal, normal) < 0.0 ? -flat_normal : flat_normal) / size;
}

struct ShadowReceiver {
  vec2 texel;   // Position in the slice's map, texels.
  vec2 slope;   // Depth of the receiver's plane per texel, metres.
  float depth;  // Metres.
  float bias;   // Metres.
  vec2 step_x;  // What one pixel of the picture covers, texels: the visibility is its mean.
  vec2 step_y;
};

// What 2×2 texels hold against the receiver, in the order of textureGather: (0,1), (1,1), (1,0),
// (0,0) from the lower left.
struct ShadowQuad {
  vec4 height;  // Metres towards the sun from the receiver's point.
  vec4 excess;  // Metres towards the sun from the receiver's plane at the texel, less the bias.
};

ShadowQuad ShadowFetch(int set, int slice, vec4 size, ShadowReceiver r, vec2 corner) {
  vec2 map_texels = vec2(textureSize(shadow_maps[2 * set], 0).xy);
  vec4 depth =
      textureGather(shadow_maps[2 * set], vec3((corner + 1.0) / map_texels, float(slice)), 0);
  // Where nothing was drawn nothing blocks, however deep the receiver lies.
  depth = depth * size.w + 1e6 * vec4(greaterThanEqual(depth, vec4(1.0)));
  vec2 offset = corner + 0.5 - r.texel;
  float plane = dot(r.slope, offset) - r.bias;
  ShadowQuad quad;
  quad.height = r.depth - depth;
  quad.excess = quad.height + plane + vec4(r.slope.y, r.slope.x + r.slope.y, r.slope.x, 0.0);
  return quad;
}

vec4 ShadowBlocks(ShadowQuad quad, float least_height) {
  return vec4(greaterThan(quad.excess, vec4(0.0))) *
         vec4(greaterThan(quad.height, vec4(least_height)));
}

// Point i of a sequence spread evenly over the pixel's footprint, texels from its middle. Roberts
// 2018, "The unreasonable effectiveness of quasirandom sequences": R2, from the plastic number.
vec2 ShadowFootprint(ShadowReceiver r, int i) {
  vec2 in_pixel = fract(0.5 + float(i + 1) * vec2(0.7548776662, 0.5698402910)) - 0.5;
  return in_pixel.x * r.step_x + in_pixel.y * r.step_y;
}

// Share of the 2×2 texels around `texel` that let light pass, weighted bilinearly.
float ShadowTap(int set, int slice, vec4 size, ShadowReceiver r, vec2 texel, float least_height) {
  vec2 corner = floor(texel - 0.5);
  vec2 f = texel - 0.5 - corner;
  vec4 blocks = ShadowBlocks(ShadowFetch(set, slice, size, r, corner), least_height);
  vec4 weights = vec4((1.0 - f.x) * f.y, f.x * f.y, f.x * (1.0 - f.y), (1.0 - f.x) * (1.0 - f.y));
  return 1.0 - dot(blocks, weights);
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

// Mean over the pixel: `step_x`, `step_y` are how far `position` moves to the next pixel (dFdx,
// dFdy, taken where all pixels run).
float ShadowVisibility(int set, vec3 position, vec3 normal, vec3 step_x, vec3 step_y) {
  vec3 to_sun = shadow_sets[set].to_sun.xyz;
  float facing = dot(normal, to_sun);
  int count = int(shadow_sets[set].settings.x);
  int slice = -1;
  // The finest slice whose window holds the point.
  for (int i = count - 1; i >= 0; --i) {
    ShadowSlice s = shadow_sets[set].slices[i];
    vec2 texel = vec2(dot(s.u_from_marker.xyz, position) + s.u_from_marker.w,
                      dot(s.v_from_marker.xyz, position) + s.v_from_marker.w);
    if (all(greaterThan(texel, vec2(2.0))) && all(lessThan(texel, vec2(s.size.z - 2.0)))) slice = i;
  }
  int chosen = max(slice, 0);
  ShadowSlice s = shadow_sets[set].slices[chosen];
  ShadowReceiver r;
  r.texel = vec2(dot(s.u_from_marker.xyz, position) + s.u_from_marker.w,
                 dot(s.v_from_marker.xyz, position) + s.v_from_marker.w);
  r.depth = dot(s.depth_from_marker.xyz, position) + s.depth_from_marker.w;
  // Plane n·Δ = 0 with Δ = a u + b v − Δdepth to_sun.
  vec2 slope = vec2(dot(normal, shadow_sets[set].light_u.xyz),
                    dot(normal, shadow_sets[set].light_v.xyz)) / max(facing, 0.02);
  r.slope = slope * s.size.xy;
  r.step_x = vec2(dot(s.u_from_marker.xyz, step_x), dot(s.v_from_marker.xyz, step_x));
  r.step_y = vec2(dot(s.u_from_marker.xyz, step_y), dot(s.v_from_marker.xyz, step_y));
  r.bias = shadow_sets[set].settings.y + 0.05 * length(r.slope);
#ifndef SHADOW_METHOD_SUN_DISC
  vec2 map_texels = vec2(textureSize(shadow_maps[2 * set], 0).xy);
  vec2 moments =
      textureLod(shadow_maps[2 * set], vec3(r.texel / map_texels, float(chosen)), 0.0).rg;
  float sigma_min = (shadow_sets[set].settings.z + length(r.slope)) / s.size.w;
  float variance = max(moments.y - moments.x * moments.x, sigma_min * sigma_min);
  float depth = (r.depth - r.bias) / s.size.w - 0.5;
#ifdef SHADOW_METHOD_GAUSSIAN
  float visible = GaussianVisibility(depth, moments.x, variance);
#else
  float visible = VarianceVisibility(depth, moments.x, variance);
#endif
#else
  float visible =
      ShadowDiscVisibility(set, chosen, s.size, r, shadow_sets[set].to_sun.w);
#endif
  // Outside every window nothing casts; a surface turned away is in its own shade.
  visible = slice < 0 ? 1.0 : visible;
  return facing > 0.0 ? visible : 0.0;
}

// At the point alone.
float ShadowVisibility(int set, vec3 position, vec3 normal) {
  return ShadowVisibility(set, position, normal, vec3(0.0), vec3(0.0));
}

// Whether `position` lies in the finest partition of the set's maps. Outside it, maps fitted to a
// region (ShadowMaps::UpdateForRegion) with and without the region's objects give the same.
bool ShadowInFinestPartition(int set, vec3 position) {
  ShadowSlice s = shadow_sets[set].slices[0];
  vec2 texel = vec2(dot(s.u_from_marker.xyz, position) + s.u_from_marker.w,
                    dot(s.v_from_marker.xyz, position) + s.v_from_marker.w);
  return all(greaterThan(texel, vec2(0.0))) && all(lessThan(texel, vec2(s.size.z)));
}

#endif
