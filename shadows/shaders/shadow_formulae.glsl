// Formulae of shadow visibility that need no texture; compiled as C++ too (gl/glsl_as_cpp.h,
// tests/shadows/formulae_test.cc).
#ifndef PLEINAIR_SHADOW_FORMULAE
#define PLEINAIR_SHADOW_FORMULAE

// Point i of n points evenly distributed over the unit disc. Vogel 1979, "A better way to construct
// the sunflower head", Math. Biosci. 44: golden angle 2.39996 rad, radius ∝ √.
vec2 VogelDisc(int i, int n) {
  float radius = sqrt((float(i) + 0.5f) / float(n));
  float angle = 2.3999632f * float(i);
  return vec2(radius * cos(angle), radius * sin(angle));
}

// Overlap of a box of ±k texels with two adjacent texels, times 2 k; `offset`: from the point to
// the centre of the first. ±½ is the bilinear filter.
vec2 ShadowBoxShares(float offset, float k) {
  vec2 start = vec2(offset - 0.5f, offset + 0.5f);
  return clamp(k - start, 0.0f, 1.0f) - clamp(-k - start, 0.0f, 1.0f);
}

// Maximum radius of a penumbra kernel, in texels: texels farther away may lie outside the map.
// Mirrors WidestKernel in shadows/light_window.h.
float ShadowWidestKernel(float resolution) { return min(128.0f, resolution / 8.0f); }

// Minimum height of a blocker at that distance from the receiver's ray: a tenth of the height of
// the disc's outermost ray there. The full height would be too much: a surface visible from the sun
// may hide a lower one beneath it, or the ray may have hit the same object before. A sunlit wall
// that rises from the ground has a hundredth.
float ShadowMinHeight(float distance_m, float tan_radius) {
  return max(0.1f * distance_m / tan_radius, 0.0f);
}

// Rise over distance below which a surface within the pixel's own footprint is the foot of a lit
// wall next to the receiver, which another pixel shows, and not a blocker.
const float kShadowWallRise = 3.0f;

// The same height for the search, which covers the disc's outermost ray and the pixel together:
// `away_m` from the receiver, of which `pixel_m` belongs to the pixel.
float ShadowMinHeightSought(float away_m, float pixel_m, float tan_radius) {
  return max(ShadowMinHeight(away_m - pixel_m, tan_radius), kShadowWallRise * away_m);
}

// Thresholds for the cosine of the sun's incidence. Below the first a surface counts as facing
// away: it receives less than a thousandth of the sunlight, and position derivatives do not
// determine its side. Below the second its plane is taken to be no steeper: beyond the rim of an
// edge-on leaf its plane is wrong, but that of the ground under a sun of 0.3° is right. Below the
// third its slope does not increase the depth tolerance further.
const float kShadowMinFacing = 0.001f, kShadowSteepest = 0.005f, kShadowMaxRise = 0.02f;

bool ShadowFaces(float facing) { return facing > kShadowMinFacing; }
float ShadowPlaneFacing(float facing) { return max(facing, kShadowSteepest); }
// Depth tolerance of a plane that rises by `slope` from texel to texel.
float ShadowRise(float slope, float facing) { return slope * min(facing / kShadowMaxRise, 1.0f); }

// A line in a texel of a map: the unit vector from the texel's centre to it, and its distance in
// texels. EdgeMap::Packed() (shadows/edge_map.h) packs it; 0 is no line.
vec3 EdgeLine(uint code) {
  vec2 steps = vec2(float((code >> 10) & 2047u), float((code >> 21) & 2047u));
  return vec3(steps / 1023.0f - 1.0f, float(code & 1023u) * (0.75f / 1023.0f));
}

// Share of a box that lies beyond a line. `half_sides`: of the box along the axes; `line`: the unit
// vector across it, and its signed distance from the box's centre along that. It is the integral of
// a step over a box, which is a spline of the second order.
float ShareBeyond(vec2 half_sides, vec3 line) {
  vec2 reach = max(abs(vec2(line.x, line.y)) * half_sides, 1e-3f);
  float sum = reach.x + reach.y, difference = reach.x - reach.y;
  vec4 t = max(vec4(sum, difference, -difference, -sum) - line.z, 0.0f);
  return clamp((t.x * t.x - t.y * t.y - t.z * t.z + t.w * t.w) / (8.0f * reach.x * reach.y), 0.0f, 1.0f);
}

// Share of a box beyond both of two lines, from the share beyond each. It is all of the smaller one
// where they are parallel, and none where they face away from each other. It is the product where
// they are perpendicular, which is exact along the axes. `cosine`: between their vectors.
float ShareBeyondBoth(float first, float second, float cosine) {
  return mix(first * second, cosine > 0.0f ? min(first, second) : 0.0f, abs(cosine));
}

// Standard normal distribution function by the logistic fit of Bowling et al. 2009, "A logistic
// approximation to the cumulative normal distribution", Eq. (10): error at most 1.4e-4.
float NormalCdf(float x) {
  return 1.0f / (1.0f + exp(-(0.07056f * x * x * x + 1.5976f * x)));
}

// The paper's visibility from mean and variance of the surrounding depths (Kolivand & Sunar 2014,
// step 6, after Gumbau et al. 2011): the part of a Gaussian depth distribution beyond the receiver.
// Deviation: 1 − Φ as printed darkens every lit surface to ½; the one-tailed form does not.
float GaussianVisibility(float depth, float mean, float variance) {
  float x = (depth - mean) / sqrt(variance);
  float tail = 2.0f * (1.0f - NormalCdf(max(x, 0.0f)));
  return min(tail, 1.0f);
}

// Upper bound of the share of depths at or beyond the receiver: one-tailed Chebyshev inequality,
// Donnelly & Lauritzen 2006, Eq. (5). Exact for one occluding plane parallel to the receiver.
float VarianceVisibility(float depth, float mean, float variance) {
  float d = max(depth - mean, 0.0f);
  return variance / (variance + d * d);
}

// Treats the tail below `amount` as light bleeding and removes it: Lauritzen 2007, "Summed-Area
// Variance Shadow Maps", GPU Gems 3, §8.4.3.
float ReduceBleeding(float visibility, float amount) {
  return clamp((visibility - amount) / (1.0f - amount), 0.0f, 1.0f);
}

// Exponent of the warps over depths −1…1: e^2c must stay below the largest 32-bit float, c < 44.
const float kShadowWarp = 40.0f;

// Lauritzen & McCool 2008, "Layered Variance Shadow Maps", §4: warps depths −½…½ so that depths
// near the receiver are separated from those far in front (x) or far behind (y).
vec2 ShadowWarp(float depth) {
  return vec2(exp(2.0f * kShadowWarp * depth), -exp(-2.0f * kShadowWarp * depth));
}

#endif
