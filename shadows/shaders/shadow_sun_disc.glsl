// Ours: percentage-closer soft shadows with the geometry of the sun.
#ifndef PLEINAIR_SHADOW_SUN_DISC
#define PLEINAIR_SHADOW_SUN_DISC
#include "shadows/shaders/shadow_caster_edges.glsl"
#include "shadows/shaders/shadow_formulae.glsl"
#include "shadows/shaders/shadow_lookup.glsl"

// Maximum numbers of samples.
const float kSearchSamples = 24.0, kFilterSamples = 200.0;

// Minimum and maximum depth in a block of the pyramid that covers a radius of `reach` texels, and
// the distance of the block's farthest corner from the receiver in texels (z).
vec3 ShadowBounds(int set, int slice, vec4 size, vec2 texel, float reach) {
  // Level 0 of the pyramid bounds 4×4 texels; a block is 2×2 of the level's texels.
  int top = max(min(findMSB(int(size.z)) - 3, 6), 0);
  int level = clamp(int(ceil(log2(max(reach, 1.0)))) - 1, 0, top);
  float side = exp2(float(level + 2));
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

// Number of sample points for an area of `square_texels` over π (a tap covers four texels):
// `a_texel` each, plus the minimum. Not an integer: the last point has a fractional weight, so that
// nothing jumps when one is added.
float ShadowCount(float square_texels, float a_texel, float minimum, float maximum) {
  return clamp(minimum + a_texel * square_texels, minimum, maximum);
}

// Rotation of VogelDisc from point to point, 2.39996 rad: saves a sine and a cosine per point.
const mat2 kGoldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

// Variance of a pixel relative to the square of its side: a box has 1/12. With this value edges are
// as stable as the ground truth's while a camera moves slowly.
const float kPixelVariance = 1.0 / 11.0;

// Half-widths of the box over texels with the same standard deviation as disc and pixel together: a
// disc of radius ρ has the variance ρ²/4 along an axis, a box of ±k has k²/3.
vec2 ShadowBoxWidth(vec4 size, ShadowReceiver r, float height, float tan_radius) {
  vec2 disc = height * tan_radius / size.xy;
  vec2 pixel = kPixelVariance * (r.step_x * r.step_x + r.step_y * r.step_y);
  return sqrt(3.0 * (0.25 * disc * disc + pixel));
}

// Visibility from the 4×4 texels around a point: a box whose width follows from the mean `height`
// of their blockers, the `occluders`. The widest box that fits is ±1½ texels.
float ShadowDense(int set, int slice, vec4 size, ShadowReceiver r, float tan_radius,
                  out float height, out float occluders) {
  vec2 corner = floor(r.texel - 0.5) - 1.0;
  vec4 blocks[4];
  vec4 heights = vec4(0.0), blockers = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    ShadowQuad quad =
        ShadowFetch(set, slice, size, r, corner + 2.0 * vec2(float(i & 1), float(i >> 1)));
    blocks[i] = vec4(greaterThan(quad.excess, vec4(0.0)));
    heights += blocks[i] * quad.height;
    blockers += blocks[i];
  }
  occluders = dot(blockers, vec4(1.0));
  height = max(dot(heights, vec4(1.0)), 0.0) / max(occluders, 1.0);
  vec2 k = clamp(ShadowBoxWidth(size, r, height, tan_radius), vec2(0.5), vec2(1.5));
  vec2 offset = corner + 0.5 - r.texel;
  float blocked = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 x = ShadowBoxShares(offset.x + 2.0 * float(i & 1), k.x);
    vec2 y = ShadowBoxShares(offset.y + 2.0 * float(i >> 1), k.y);
    // A quad's order is (0,1), (1,1), (1,0), (0,0).
    blocked += dot(blocks[i], vec4(x, x.yx) * y.yyxx);
  }
  return max(1.0 - blocked / (4.0 * k.x * k.y), 0.0);
}

// Sample points evenly distributed over an ellipse with the same standard deviations as disc and
// pixel together. (Points of the disc with an individual offset in the pixel flicker twice as
// much.) One sample where the result is not needed.
float ShadowEvenSpread(int set, int slice, vec4 size, ShadowReceiver r, float tan_radius,
                       float height, bool wanted) {
  // A tap is a tent of variance 1/6 texel² per axis; a disc of radius ρ has ρ²/4.
  float texel_m = max(size.x, size.y);
  float disc_m = min(height * tan_radius, ShadowWidestKernel(size.z) * min(size.x, size.y));
  float filter_m = sqrt(max(disc_m * disc_m - 2.0 / 3.0 * texel_m * texel_m, 0.0));
  vec2 disc = filter_m / size.xy;
  vec2 across = 0.25 * disc * disc + kPixelVariance * (r.step_x * r.step_x + r.step_y * r.step_y);
  float skew = kPixelVariance * (r.step_x.x * r.step_x.y + r.step_y.x * r.step_y.y);
  vec2 along = vec2(across.x, skew) / sqrt(max(across.x, 1e-12));  // Cholesky's factors.
  mat2 ellipse = 2.0 * mat2(along, vec2(0.0, sqrt(max(across.y - along.y * along.y, 0.0))));
  float visible = 0.0;
  float count = wanted ? ShadowCount(ellipse[0].x * ellipse[1].y, 2.0, 20.0, kFilterSamples) : 0.0;
  vec2 spoke = vec2(1.0, 0.0);
  int i = 0;
  do {
    float radius = sqrt((float(i) + 0.5) / (count + 0.5));
    vec2 texel = r.texel + ellipse * (radius * spoke);
    spoke = kGoldenTurn * spoke;
    float weight = min(count - float(i), 1.0);
    float min_m = ShadowMinHeight(radius * filter_m - texel_m, tan_radius);
    visible += weight * ShadowTap(set, slice, size, r, texel, min_m);
  } while (float(++i) < count);
  return visible / max(count, 1e-3);
}

// Visibility of the sun's disc by percentage-closer soft shadows (Fernando 2005) with the geometry
// of the sun: a blocker h metres away shades a disc of radius h tan 0.2665° around it. Deviations:
// (1) the search radius is limited by the highest blocker nearby, found in a pyramid of depth
// bounds, so that most pixels need no search; (2) depths are compared with the receiver's plane,
// texel by texel, so that a lit plane needs almost no bias; (3) surfaces too low for any ray of the
// disc at their distance are ignored (the foot of a sunlit wall).
float ShadowDiscVisibility(int set, int slice, vec4 size, ShadowReceiver r, float tan_radius,
                           bool wanted) {
  float texel_m = max(size.x, size.y);
  float slope_texel = length(r.slope);
  float footprint = 0.5 * (length(r.step_x) + length(r.step_y));
  // Bounds: start from the near plane, then tighten.
  float reach = r.depth * tan_radius / min(size.x, size.y) + footprint + 1.0;
  vec3 bounds = ShadowBounds(set, slice, size, r.texel, reach);
  reach = max(r.depth - bounds.x, 0.0) * tan_radius / min(size.x, size.y) + footprint + 1.0;
  bounds = ShadowBounds(set, slice, size, r.texel, reach);
  float highest_m = max(r.depth - bounds.x, 0.0);
  float search_m = min(highest_m * tan_radius, ShadowWidestKernel(size.z) * min(size.x, size.y));

  bool umbra = bounds.y < r.depth - slope_texel * bounds.z - r.bias;
  // Boxes of more than ±1½ texels do not fit into 4×4 texels.
  vec2 widest = 0.75 * search_m * search_m / (size.xy * size.xy) +
                3.0 * kPixelVariance * (r.step_x * r.step_x + r.step_y * r.step_y);
  bool soft = max(widest.x, widest.y) > 2.25 && !umbra && wanted;

  // Mean height of the blockers that rays from the pixel to the disc can hit. Loops with a count of
  // 0 in place of branches: Mesa's software renderer executes both sides of an `if`, but skips a
  // loop.
  float height_sum = 0.0;
  float blockers = 0.0;
  float pixel_m = footprint * texel_m;
  float search_texels = search_m / texel_m + footprint;
  float search_count =
      soft ? ShadowCount(search_texels * search_texels, 0.6, 6.0, kSearchSamples) : 0.0;
  vec2 spoke = vec2(1.0, 0.0);
  int i = 0;
  do {
    vec2 offset_m = (search_m + pixel_m) * sqrt((float(i) + 0.5) / (search_count + 0.5)) * spoke;
    float weight = clamp(search_count - float(i), 0.0, 1.0);
    spoke = kGoldenTurn * spoke;
    vec2 corner = floor(r.texel + offset_m / size.xy - 0.5);
    ShadowQuad quad = ShadowFetch(set, slice, size, r, corner);
    float away_m = length(offset_m) - texel_m;
    float min_m = ShadowMinHeightSought(away_m, pixel_m, tan_radius);
    vec4 blocks = ShadowBlocks(quad, min_m);
    height_sum += weight * dot(blocks, quad.height);
    blockers += weight * dot(blocks, vec4(1.0));
  } while (float(++i) < search_count);
  soft = blockers > 0.0;
  float height = height_sum / max(blockers, 1e-3), dense_height, occluders;
  float spread = ShadowEvenSpread(set, slice, size, r, tan_radius, height, soft);
  float dense = ShadowDense(set, slice, size, r, tan_radius, dense_height, occluders);
  bool at_edge = soft ? spread > 0.0 && spread < 1.0 : occluders > 0.0 && occluders < 16.0;
  vec2 k = ShadowBoxWidth(size, r, soft ? height : dense_height, tan_radius);
  return ShadowAtEdges(set, slice, size, r, k, at_edge, soft ? spread : dense);
}

#endif
