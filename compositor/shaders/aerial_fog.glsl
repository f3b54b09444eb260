#ifndef COMPOSITOR_AERIAL_FOG_GLSL
#define COMPOSITOR_AERIAL_FOG_GLSL
// Fog by partition, compositor/passes/aerial_fog.h: what the air does up to each split of the view.
const int kFogSplits = 5;

struct FogAir {
  vec3 left;   // Share of a thing's light that comes through.
  vec3 light;  // The air's own, cd/m².
};

// The air up to `distance_m` (Preetham et al. 1999, §4). Between two splits it is taken as even: its
// optical depth grows with distance, its light with the share of the split's extinction that lies
// behind.
FogAir FogUpTo(float distance_m, const float split_m[kFogSplits],
               const vec3 optical_depth[kFogSplits], const vec3 inscattered[kFogSplits]) {
  // From the eye to the first split.
  float share = clamp(distance_m / max(split_m[0], 1e-6f), 0.0f, 1.0f);
  vec3 depth = share * optical_depth[0];
  vec3 light = share * inscattered[0];
  for (int i = 1; i < kFogSplits; ++i) {
    float length_m = max(split_m[i] - split_m[i - 1], 1e-6f);
    share = clamp((distance_m - split_m[i - 1]) / length_m, 0.0f, 1.0f);
    vec3 here = optical_depth[i] - optical_depth[i - 1];
    // (1 − e^−x share) / (1 − e^−x), x the split's own depth; `share` itself in thin air.
    vec3 whole = 1.0f - exp(-here);
    vec3 lit = mix((1.0f - exp(-share * here)) / max(whole, vec3(1e-6f)), vec3(share),
                   vec3(lessThan(here, vec3(1e-3f))));
    depth += share * here;
    light += lit * (inscattered[i] - inscattered[i - 1]);
  }
  FogAir air;
  air.left = exp(-depth);
  air.light = light;
  return air;
}

// What a virtual shadow of ratio R (differential.glsl) adds to R times a needs_airlight picture, display-linear.
// The picture P = L τ + A has the air's light A in it, which no shadow takes away: R L τ + A =
// R P + (1 − R) A. A picture darker than the air is said to be takes that to be its air.
vec3 AirlightOverShadow(vec3 ratio, vec3 air_light, vec3 picture) {
  return (1.0f - ratio) * min(air_light, picture);
}

#endif
