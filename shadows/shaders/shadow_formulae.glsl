// Formulae of shadow visibility that need no picture; compiled as C++ too (gl/glsl_as_cpp.h,
// tests/shadows/formulae_test.cc).
#ifndef PLEINAIR_SHADOW_FORMULAE
#define PLEINAIR_SHADOW_FORMULAE

// Point i of n spread evenly over the unit disc. Vogel 1979, "A better way to construct the
// sunflower head", Math. Biosci. 44: golden angle 2.39996 rad, radius ∝ √.
vec2 VogelDisc(int i, int n) {
  float radius = sqrt((float(i) + 0.5f) / float(n));
  float angle = 2.3999632f * float(i);
  return vec2(radius * cos(angle), radius * sin(angle));
}

// Share that a box of ±k texels has of two texels side by side, times 2 k; `offset`: from the point
// to the first one's centre. ±½ is the bilinear filter.
vec2 ShadowBoxShares(float offset, float k) {
  vec2 start = vec2(offset - 0.5f, offset + 0.5f);
  return clamp(k - start, 0.0f, 1.0f) - clamp(-k - start, 0.0f, 1.0f);
}

// Radius, in texels, beyond which no penumbra is followed: what lies further may lie outside the
// map. Mirrors WidestKernel in shadows/light_window.h.
float ShadowWidestKernel(float resolution) { return min(128.0f, resolution / 8.0f); }

// Height below which a surface that far from the receiver's ray is no blocker: a tenth of what the
// disc's widest ray has there. All of it would be too much: what is seen from the sun may hide
// something lower beneath it, or the ray may have met the same thing before; a sunlit wall that
// rises from the ground has a hundredth.
float ShadowMinHeight(float distance_m, float tan_radius) {
  return max(0.1f * distance_m / tan_radius, 0.0f);
}

// Rise over distance below which what the pixel alone covers is the foot of a lit wall beside the
// receiver, which another pixel shows, and no blocker.
const float kShadowWallRise = 3.0f;

// The same height for the search, which looks over the disc's widest ray and the pixel together:
// `away_m` from the receiver, of which the pixel has `pixel_m`.
float ShadowMinHeightSought(float away_m, float pixel_m, float tan_radius) {
  return max(ShadowMinHeight(away_m - pixel_m, tan_radius), kShadowWallRise * away_m);
}

// Cosines of the sun's incidence, below which: a surface counts as turned away (it gets less than a
// thousandth of the sun's light, and derivatives of positions tell its side no better); its plane is
// taken to be no steeper (what lies beyond an edge-on leaf's rim is not its plane, but the ground
// under a sun of 0.3° is); and its steepness excuses no more depth.
const float kShadowMinFacing = 0.001f, kShadowSteepest = 0.005f, kShadowMaxRise = 0.02f;

bool ShadowFaces(float facing) { return facing > kShadowMinFacing; }
float ShadowPlaneFacing(float facing) { return max(facing, kShadowSteepest); }
// Of a plane that rises by `slope` from texel to texel.
float ShadowRise(float slope, float facing) { return slope * min(facing / kShadowMaxRise, 1.0f); }

// Standard normal distribution function by the logistic fit of Bowling et al. 2009, "A logistic
// approximation to the cumulative normal distribution", Eq. (10): error at most 1.4e-4.
float NormalCdf(float x) {
  return 1.0f / (1.0f + exp(-(0.07056f * x * x * x + 1.5976f * x)));
}

// The paper's visibility from mean and variance of the depths around (Kolivand & Sunar 2014, step
// 6, after Gumbau et al. 2011): the part of a Gaussian depth distribution beyond the receiver.
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

// Takes the tail below `amount` for a leak and cuts it off: Lauritzen 2007, "Summed-Area Variance
// Shadow Maps", GPU Gems 3, §8.4.3.
float ReduceBleeding(float visibility, float amount) {
  return clamp((visibility - amount) / (1.0f - amount), 0.0f, 1.0f);
}

// Exponent of the warps over depths −1…1: e^2c must stay below the largest 32-bit float, c < 44.
const float kShadowWarp = 40.0f;

// Lauritzen & McCool 2008, "Layered Variance Shadow Maps", §4: depths −½…½ warped so that what lies
// near the receiver stands apart from what lies far in front (x) or far behind (y).
vec2 ShadowWarp(float depth) {
  return vec2(exp(2.0f * kShadowWarp * depth), -exp(-2.0f * kShadowWarp * depth));
}

#endif
