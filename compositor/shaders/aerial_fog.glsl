#ifndef COMPOSITOR_AERIAL_FOG_GLSL
#define COMPOSITOR_AERIAL_FOG_GLSL
// Fog by partition (compositor/passes/aerial_fog.h), accumulated up to each split of the view.
const int kFogSplits = 5;

struct FogAir {
  vec3 left;  // Transmittance: share of a surface's light.
  vec3 light;  // Inscattered light, cd/m².
};

// Evaluates the fog up to `distance_m` (Preetham et al. 1999, §4). The air is uniform between two
// splits, so the optical depth grows linearly with distance. The light grows with the share of the
// split's extinction within the distance.
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
    // (1 − e^−x share) / (1 − e^−x), where x is the segment's optical depth; `share` itself in thin
    // air.
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

// Light to add to R times a hazy image under a virtual shadow of ratio R (differential.glsl),
// display-linear. The image P = L τ + A contains the airlight A, which no shadow removes: R L τ + A
// = R P + (1 − R) A. If the image is darker than the computed airlight, all of the image is taken
// for airlight.
vec3 AirlightOverShadow(vec3 ratio, vec3 air_light, vec3 picture) {
  return (1.0f - ratio) * min(air_light, picture);
}

#endif
