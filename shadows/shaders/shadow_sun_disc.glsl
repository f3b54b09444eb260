// Ours: percentage-closer soft shadows with the sun's own geometry.
#ifndef PLEINAIR_SHADOW_SUN_DISC
#define PLEINAIR_SHADOW_SUN_DISC
#include "shadows/shaders/shadow_formulae.glsl"
#include "shadows/shaders/shadow_lookup.glsl"

#ifndef SHADOW_SEARCH_SAMPLES
#define SHADOW_SEARCH_SAMPLES 24
#endif
#ifndef SHADOW_FILTER_SAMPLES
#define SHADOW_FILTER_SAMPLES 200
#endif

// Nearest and farthest depth in a block of the pyramid that covers `reach` texels around, and the
// block's farthest corner from the receiver in texels (z).
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

// Points for an area of `square_texels` over π, a tap seeing four texels: `a_texel` each on top of
// `least`. Not a whole number: the last point weighs less, so that nothing jumps where one is added.
float ShadowCount(float square_texels, float a_texel, float least, float most) {
  return clamp(least + a_texel * square_texels, least, most);
}

// VogelDisc's turn from point to point, 2.39996 rad: spares a sine and a cosine a point.
const mat2 kGoldenTurn = mat2(-0.73736888, 0.67549029, -0.67549029, -0.73736888);

// Share that a box of ±k texels around the middle of 4×4 texels has of each of the four along an
// axis, times 2 k; f: the point's offset from the second one's centre. ±½ is the bilinear filter.
vec4 ShadowBoxShares(float f, float k) {
  const vec4 kStart = vec4(-0.5, 0.5, 1.5, 2.5);
  return clamp(1.0 + f + k - kStart, 0.0, 1.0) - clamp(1.0 + f - k - kStart, 0.0, 1.0);
}

// Where 4×4 texels hold all that the disc and the pixel can see: their blockers' mean height, and
// a box as wide as it asks.
float ShadowNarrow(int set, int slice, vec4 size, ShadowReceiver r, float tan_radius) {
  vec2 corner = floor(r.texel - 0.5) - 1.0;
  vec2 f = r.texel - 1.5 - corner;
  vec4 blocks[4];
  vec4 heights = vec4(0.0);
  vec4 blockers = vec4(0.0);
  for (int i = 0; i < 4; ++i) {
    ShadowQuad quad =
        ShadowFetch(set, slice, size, r, corner + vec2(2.0 * float(i & 1), 2.0 * float(i >> 1)));
    blocks[i] = vec4(greaterThan(quad.excess, vec4(0.0)));
    heights += blocks[i] * quad.height;
    blockers += blocks[i];
  }
  float height = max(dot(heights, vec4(1.0)), 0.0) / max(dot(blockers, vec4(1.0)), 1.0);
  // A disc of radius ρ is as wide, in standard deviations, as a box of ±ρ√¾; a pixel is a box.
  vec2 disc = height * tan_radius / size.xy;
  vec2 pixel = 0.5 * (abs(r.step_x) + abs(r.step_y));
  vec2 k = clamp(sqrt(0.75 * disc * disc + pixel * pixel), vec2(0.5), vec2(1.5));
  vec4 x = ShadowBoxShares(f.x, k.x), y = ShadowBoxShares(f.y, k.y);
  // Row by row; a quad's order is (0,1), (1,1), (1,0), (0,0).
  vec4 rows = vec4(dot(vec4(blocks[0].wz, blocks[1].wz), x), dot(vec4(blocks[0].xy, blocks[1].xy), x),
                   dot(vec4(blocks[2].wz, blocks[3].wz), x), dot(vec4(blocks[2].xy, blocks[3].xy), x));
  return 1.0 - dot(rows, y) / (4.0 * k.x * k.y);
}

// Share of the 2×2 texels around a place that blocks, weighted bilinearly.
float ShadowBlocked(int set, int slice, vec4 size, ShadowReceiver r, vec2 texel) {
  return 1.0 - ShadowTap(set, slice, size, r, texel, -1e30);
}

// Deviations along both axes, texels, of what disc and pixel spread beyond one look's own tent
// (variance 1/6 texel² an axis).
vec2 ShadowSpread(ShadowReceiver r, float height, float tan_radius_texels) {
  float disc = max(height, 0.0) * tan_radius_texels;
  vec2 pixel2 = r.step_x * r.step_x + r.step_y * r.step_y;
  return sqrt(max(0.25 * disc * disc + pixel2 / 12.0 - 1.0 / 6.0, 0.0));
}

// Five looks, one amid four on a square turned by atan ½, so that an edge along an axis passes them
// one by one: (4 + 1 + 4 + 1)/5 (σ/√2)² = σ². Three quads on a diagonal tell the blockers' height:
// one alone sees none on most of the lit side of a penumbra, and another one at every texel.
float ShadowFiveLooks(int set, int slice, vec4 size, ShadowReceiver r, float tan_radius) {
  vec4 heights = vec4(0.0), blockers = vec4(0.0);
  float blocked = 0.0;
  for (int i = -1; i <= 1; ++i) {
    vec2 corner = floor(r.texel + 2.0 * float(i) - 0.5);
    ShadowQuad quad = ShadowFetch(set, slice, size, r, corner);
    vec4 blocks = vec4(greaterThan(quad.excess, vec4(0.0)));
    heights += blocks * quad.height;
    blockers += blocks;
    if (i == 0) blocked = ShadowBilinear(blocks, r.texel - 0.5 - corner);
  }
  float height = dot(heights, vec4(1.0)) / max(dot(blockers, vec4(1.0)), 1.0);
  vec2 apart = sqrt(0.5) * ShadowSpread(r, height, tan_radius / size.x);
  vec2 far = apart * vec2(2.0, 1.0), across = apart * vec2(-1.0, 2.0);
  blocked += ShadowBlocked(set, slice, size, r, r.texel + far);
  blocked += ShadowBlocked(set, slice, size, r, r.texel - far);
  blocked += ShadowBlocked(set, slice, size, r, r.texel + across);
  blocked += ShadowBlocked(set, slice, size, r, r.texel - across);
  return 1.0 - blocked / 5.0;
}

// Visibility of the sun's disc by percentage-closer soft shadows (Fernando 2005) with the sun's own
// geometry: a blocker h metres away shades a disc of h tan 0.2665° around it.
// Deviations: (1) the search looks only as far as the highest blocker nearby can matter, found
// in a pyramid of depth bounds, so that most pixels need no search at all; (2) depths are compared
// with the receiver's plane, texel by texel, so a lit plane needs no bias to speak of; (3) blockers
// too low for any ray of the disc at their distance are left out (the foot of a sunlit wall).
// (4) a pixel's variance is taken as 1/11 in place of a box's 1/12: edges then stand as still as the
// truth's while a camera creeps.
const float kPixelVariance = 1.0 / 11.0;

float ShadowDiscVisibility(int set, int slice, vec4 size, ShadowReceiver r, float tan_radius,
                           bool wanted) {
  float texel_m = max(size.x, size.y);
  float slope_texel = length(r.slope);
  float footprint = 0.5 * (length(r.step_x) + length(r.step_y));
  // Bounds: start with what anything up to the near plane could do, then tighten.
  float reach = r.depth * tan_radius / min(size.x, size.y) + footprint + 1.0;
  vec3 bounds = ShadowBounds(set, slice, size, r.texel, reach);
  reach = max(r.depth - bounds.x, 0.0) * tan_radius / min(size.x, size.y) + footprint + 1.0;
  bounds = ShadowBounds(set, slice, size, r.texel, reach);
  float highest_m = max(r.depth - bounds.x, 0.0);
  // At most what the pyramid's widest blocks cover.
  float search_m = min(highest_m * tan_radius, 128.0 * min(size.x, size.y));

  // The bilinear tap is a tent of variance 1/6 texel² a axis; a disc of radius ρ has ρ²/4: below
  // that the tap alone is soft enough.
  float tap_radius2_m = (2.0 / 3.0) * texel_m * texel_m;
  bool umbra = bounds.y < r.depth - slope_texel * bounds.z - r.bias;
  // Nothing within reach rises above the receiver's plane.
  bool lit = highest_m < slope_texel * bounds.z + r.bias;
  // Boxes of more than ±1½ texels do not fit into 4×4 texels.
  vec2 pixel = sqrt(3.0 * kPixelVariance) * (abs(r.step_x) + abs(r.step_y));
  vec2 widest = 0.75 * search_m * search_m / (size.xy * size.xy) + pixel * pixel;
  bool soft = max(widest.x, widest.y) > 2.25 && !lit && !umbra && wanted;

  // Mean height of the blockers that the disc's rays can meet. Loops with a count of 0 instead of
  // branches: Mesa's software renderer runs both sides of an `if`, but leaves a loop.
  float height_sum = 0.0;
  float blockers = 0.0;
  float search_texels = search_m / texel_m;
  float search_count =
      soft ? ShadowCount(search_texels * search_texels, 0.6, 6.0, float(SHADOW_SEARCH_SAMPLES)) : 0.0;
  vec2 spoke = vec2(1.0, 0.0);
  int i = 0;
  do {
    vec2 offset_m = search_m * sqrt((float(i) + 0.5) / (search_count + 0.5)) * spoke;
    float weight = min(search_count - float(i), 1.0);
    spoke = kGoldenTurn * spoke;
    vec2 corner = floor(r.texel + offset_m / size.xy - 0.5);
    ShadowQuad quad = ShadowFetch(set, slice, size, r, corner);
    // A ray that passes at this distance is already higher than a blocker below this.
    float least_m = max((length(offset_m) - texel_m) / tan_radius, 0.0);
    vec4 blocks = ShadowBlocks(quad, least_m);
    height_sum += weight * dot(blocks, quad.height);
    blockers += weight * dot(blocks, vec4(1.0));
  } while (float(++i) < search_count);
  float mean_height_m = height_sum / max(blockers, 1e-3);
  float disc_m = mean_height_m * tan_radius;
  float filter_m = sqrt(max(disc_m * disc_m - tap_radius2_m, 0.0));

  // One even spread of points over an ellipse as wide, in standard deviations, as disc and pixel
  // together. Points of the disc each moved to another place in the pixel tremble twice as much.
  vec2 disc = filter_m / size.xy;
  vec2 across = 0.25 * disc * disc + kPixelVariance * (r.step_x * r.step_x + r.step_y * r.step_y);
  float skew = kPixelVariance * (r.step_x.x * r.step_x.y + r.step_y.x * r.step_y.y);
  vec2 along = vec2(across.x, skew) / sqrt(max(across.x, 1e-12));  // Cholesky's factors.
  mat2 ellipse = 2.0 * mat2(along, vec2(0.0, sqrt(max(across.y - along.y * along.y, 0.0))));
  float visible = 0.0;
  float filter_count = soft ? ShadowCount(ellipse[0].x * ellipse[1].y, 2.0, 20.0,
                                          float(SHADOW_FILTER_SAMPLES))
                            : 0.0;
  spoke = vec2(1.0, 0.0);
  i = 0;
  do {
    float radius = sqrt((float(i) + 0.5) / (filter_count + 0.5));
    vec2 texel = r.texel + ellipse * (radius * spoke);
    spoke = kGoldenTurn * spoke;
    float weight = min(filter_count - float(i), 1.0);
    float least_m = max((0.5 * radius * filter_m - texel_m) / tan_radius, 0.0);
    visible += weight * ShadowTap(set, slice, size, r, texel, least_m);
  } while (float(++i) < filter_count);
  float narrow = ShadowNarrow(set, slice, size, r, tan_radius);
  return soft ? visible / filter_count : narrow;
}

#endif
